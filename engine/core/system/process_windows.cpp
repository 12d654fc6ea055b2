// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>
// After windows.h, which it needs.
#include <io.h>

#include <algorithm>
#include <bit>
#include <thread>

#include "engine/core/system/process.h"

namespace gloam {

double processor_time_ms() {
  FILETIME created{}, ended{}, kernel{}, user{};
  if (GetProcessTimes(GetCurrentProcess(), &created, &ended, &kernel, &user) == 0) return 0.0;
  const auto ticks = [](const FILETIME& time) {  // of 100 ns
    return static_cast<double>(std::uint64_t{time.dwHighDateTime} << 32 | time.dwLowDateTime);
  };
  return (ticks(kernel) + ticks(user)) * 1e-4;
}

std::uint32_t usable_cores() {
  DWORD_PTR own = 0, all = 0;
  if (GetProcessAffinityMask(GetCurrentProcess(), &own, &all) != 0 && own != 0)
    return static_cast<std::uint32_t>(std::popcount(std::uint64_t{own}));
  return std::max(std::thread::hardware_concurrency(), 1u);  // more than one group of processors
}

std::uint32_t process_number() { return GetCurrentProcessId(); }

bool process_exists(std::uint32_t number) {
  const HANDLE process = OpenProcess(SYNCHRONIZE, FALSE, number);
  if (process == nullptr) return GetLastError() != ERROR_INVALID_PARAMETER;
  const bool runs = WaitForSingleObject(process, 0) == WAIT_TIMEOUT;
  CloseHandle(process);
  return runs;
}

std::string host_name() {
  char host[MAX_COMPUTERNAME_LENGTH + 1] = {};
  DWORD size = sizeof(host);
  return GetComputerNameA(host, &size) != 0 ? std::string(host, size) : std::string();
}

bool flush_to_disk(std::FILE* file) { return _commit(_fileno(file)) == 0; }

void remove_in_handler(const char* path) { static_cast<void>(DeleteFileA(path)); }

}  // namespace gloam
