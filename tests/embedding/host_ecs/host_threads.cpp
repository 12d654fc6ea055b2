// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// A host that may have few threads: work goes on with those that it gets.
// usage: host_threads MOST: the number of threads of the user, 1 or more.
#include <grp.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <vector>

#include "engine/jobs/executor.h"

namespace {

constexpr int kRanges = 1000;

/// The system limits the threads of a user who is not root.
bool limit_threads(rlim_t most) {
  constexpr uid_t kOther = 54321;  // a user without processes
  const rlimit limit{most, most};
  if (setrlimit(RLIMIT_NPROC, &limit) != 0) return false;
  return getuid() != 0 || (setgroups(0, nullptr) == 0 && setgid(kOther) == 0 && setuid(kOther) == 0);
}

bool runs_all(gloam::JobExecutor& executor) {
  std::vector<std::atomic<int>> ran(kRanges);
  executor.parallel_for(kRanges, 1, [&](gloam::JobRange range) {
    ++ran[range.ordinal];
    for (volatile int work = 0; work < 20000;) work = work + 1;
  });
  for (const std::atomic<int>& times : ran)
    if (times != 1) return false;
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const auto most = static_cast<rlim_t>(argc > 1 ? std::atoi(argv[1]) : 1);
  if (!limit_threads(most)) return 77;
  for (const unsigned threads : {0u, 2u, 3u, 8u, 64u}) {
    try {
      const auto executor = gloam::make_pool_executor(threads);
      const auto second = gloam::make_pool_executor(threads);  // finds fewer threads still
      if (getuid() == 54321 && executor->worker_count() > most) {
        std::fprintf(stderr, "host_threads: %u threads, and %u may be\n", executor->worker_count(),
                     static_cast<unsigned>(most));
        return 1;
      }
      for (int call = 0; call < 3; ++call)
        if (!runs_all(*executor) || !runs_all(*second)) {
          std::fprintf(stderr, "host_threads: ranges did not run once with %u threads\n", threads);
          return 1;
        }
    } catch (const std::exception& fault) {
      std::fprintf(stderr, "host_threads: no job failed, and with %u threads: %s\n", threads, fault.what());
      return 1;
    }
  }
  return 0;
}
