// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>

#include "engine/jobs/executor.h"

namespace host {

/// Checks that failed so far.
inline int failures = 0;

inline void expect(bool is_true, const char* sentence) {
  if (is_true) return;
  ++failures;
  std::fprintf(stderr, "host_cpu: it does not hold that %s\n", sentence);
}

/// Each runs CPU systems of one module and compares their results with brute force in double precision.
void check_lights(gloam::JobExecutor& executor);
void check_umbra();
void check_mirrors(gloam::JobExecutor& executor);
void check_lawn(gloam::JobExecutor& executor);

}  // namespace host
