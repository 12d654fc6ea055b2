// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

// Pages of memory from the operating system. Each system has a file of its own: system_pages_posix.cpp and
// system_pages_windows.cpp. Sizes and addresses are multiples of system_page_size().

namespace gloam {

[[nodiscard]] std::size_t system_page_size();

/// Address space without memory.
struct ReservedPages {
  std::byte* address = nullptr;  ///< null: the system has refused it
  bool writable = false;         ///< pages need not be committed: they take memory when they are first written to
};

/// Reserves address space that begins at a multiple of `alignment`, a power of two.
[[nodiscard]] ReservedPages reserve_pages(std::size_t bytes, std::size_t alignment);
/// Makes pages of a reservation that is not writable readable, writable and zero. False: the system has refused it.
[[nodiscard]] bool commit_pages(std::byte* address, std::size_t bytes);
/// Gives back a whole reservation.
void release_pages(std::byte* address, std::size_t bytes);
/// Asks for large pages where these bytes are first touched.
void prefer_large_pages(std::byte* address, std::size_t bytes);
/// Asks to replace small pages that are in use already by large ones.
void join_small_pages(std::byte* address, std::size_t bytes);

}  // namespace gloam
