// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

// What gloam asks the operating system about processes and files. Each system has a file of its own:
// process_posix.cpp and process_windows.cpp.

namespace gloam {

/// Processor time that all threads of this process have used, in ms. Other processes hardly change the time of the same
/// work, which they do to a clock on the wall.
[[nodiscard]] double processor_time_ms();

/// Processor cores that this process may run on, >= 1.
[[nodiscard]] std::uint32_t usable_cores();

/// Number of this process on this host.
[[nodiscard]] std::uint32_t process_number();

/// Whether a process of this number exists on this host. True if the system does not tell.
[[nodiscard]] bool process_exists(std::uint32_t number);

/// Name of this host; empty if it has none.
[[nodiscard]] std::string host_name();

/// Writes what the system still holds of an open file to the disk. Returns false, with errno set, if it fails.
[[nodiscard]] bool flush_to_disk(std::FILE* file);

/// Removes a file; for handlers of signals: it allocates nothing and takes no lock.
void remove_in_handler(const char* path);

}  // namespace gloam
