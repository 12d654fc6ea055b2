// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstdio>

#include "checks.h"
#include "thread_executor.h"

int main() {
  host::ThreadExecutor executor(3);
  host::check_lights(executor);
  host::check_umbra();
  host::check_mirrors(executor);
  host::check_lawn(executor);
  if (host::failures == 0) std::puts("host_cpu: all numbers agree with brute force");
  return host::failures == 0 ? 0 : 1;
}
