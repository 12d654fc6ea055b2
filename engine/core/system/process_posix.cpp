// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <thread>

#include "engine/core/system/process.h"

namespace gloam {

double processor_time_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

std::uint32_t usable_cores() {
  cpu_set_t cores;
  if (sched_getaffinity(0, sizeof(cores), &cores) == 0)
    return std::max(static_cast<std::uint32_t>(CPU_COUNT(&cores)), 1u);
  return std::max(std::thread::hardware_concurrency(), 1u);  // more cores than a cpu_set_t holds
}

std::uint32_t process_number() { return static_cast<std::uint32_t>(getpid()); }

bool process_exists(std::uint32_t number) { return kill(static_cast<pid_t>(number), 0) == 0 || errno != ESRCH; }

std::string host_name() {
  char host[256] = {};
  return gethostname(host, sizeof(host) - 1) == 0 ? host : std::string();
}

bool flush_to_disk(std::FILE* file) { return fsync(fileno(file)) == 0; }

void remove_in_handler(const char* path) { static_cast<void>(unlink(path)); }

}  // namespace gloam
