// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// A host that keeps its executor in a static variable, with more threads than any machine has cores: it ends after
// main.
#include <atomic>
#include <cstdio>
#include <memory>

#include "engine/jobs/executor.h"

namespace {

std::unique_ptr<gloam::JobExecutor> executor;

}  // namespace

int main() {
  std::atomic<int> ran = 0;
  for (const unsigned threads : {3u, 65u}) {
    executor = gloam::make_pool_executor(threads);
    executor->parallel_for(100, 1, [&](gloam::JobRange) { ++ran; });
  }
  if (ran == 200) return 0;
  std::fprintf(stderr, "host_static: %d of 200 ranges ran\n", ran.load());
  return 1;
}
