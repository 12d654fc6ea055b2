// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#define WIN32_LEAN_AND_MEAN
#define NOMINMAX
#include <windows.h>

#include <cstdint>

#include "engine/ecs/storage/system_pages.h"

// Windows counts committed pages against its memory and page file whether they are touched or not, so a reservation is
// never writable as a whole. It has no large pages that appear by themselves.

namespace gloam {

std::size_t system_page_size() {
  static const std::size_t size = [] {
    SYSTEM_INFO info{};
    GetSystemInfo(&info);
    return std::size_t{info.dwPageSize};
  }();
  return size;
}

ReservedPages reserve_pages(std::size_t bytes, std::size_t alignment) {
  // Address space cannot be given back in parts: reserve more to find a place, then reserve there alone. Another thread
  // may take the place in between.
  constexpr int kAttempts = 8;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    void* wide = VirtualAlloc(nullptr, bytes + alignment, MEM_RESERVE, PAGE_NOACCESS);
    if (wide == nullptr) return {};
    const std::uintptr_t place = (reinterpret_cast<std::uintptr_t>(wide) + alignment - 1) / alignment * alignment;
    VirtualFree(wide, 0, MEM_RELEASE);
    void* address = VirtualAlloc(reinterpret_cast<void*>(place), bytes, MEM_RESERVE, PAGE_NOACCESS);
    if (address != nullptr) return {static_cast<std::byte*>(address), false};
  }
  return {};
}

bool commit_pages(std::byte* address, std::size_t bytes) {
  return VirtualAlloc(address, bytes, MEM_COMMIT, PAGE_READWRITE) != nullptr;
}

void release_pages(std::byte* address, std::size_t) { VirtualFree(address, 0, MEM_RELEASE); }

void prefer_large_pages(std::byte*, std::size_t) {}

void join_small_pages(std::byte*, std::size_t) {}

}  // namespace gloam
