// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/processor_time.h"

#include <algorithm>
#include <ctime>
#include <thread>

namespace gloam {

double processor_time_ms() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

std::uint32_t usable_cores() { return std::max(std::thread::hardware_concurrency(), 1u); }

}  // namespace gloam
