// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>

#include "engine/ecs/storage/system_pages.h"

// A process has a limited number of mappings (vm.max_map_count on Linux, 65,530 by default), and pages of different
// protection are different mappings. So a reservation is writable as a whole: it takes memory only where it is written
// to, and neighbouring reservations are one mapping. Where the system counts writable pages that were never written to
// against a limit (vm.overcommit_memory=2, RLIMIT_DATA), pages become writable when they are committed.

namespace gloam {
namespace {

void* map_pages(std::size_t bytes, int protection) {
  return mmap(nullptr, bytes, protection, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
}

}  // namespace

std::size_t system_page_size() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

ReservedPages reserve_pages(std::size_t bytes, std::size_t alignment) {
  const std::size_t slack = alignment > system_page_size() ? alignment : 0;
  void* address = map_pages(bytes + slack, PROT_READ | PROT_WRITE);
  const bool writable = address != MAP_FAILED;
  if (!writable) address = map_pages(bytes + slack, PROT_NONE);
  if (address == MAP_FAILED) return {};
  auto* data = static_cast<std::byte*>(address);
  if (slack > 0) {
    // As far back as it can be: Linux maps downwards, so the reservation then touches the one before, as one mapping.
    const std::size_t after = (reinterpret_cast<std::uintptr_t>(address) + bytes + slack) % alignment;
    const std::size_t before = slack - after;
    if (before > 0) munmap(data, before);
    data += before;
    if (after > 0) munmap(data + bytes, after);
  }
#ifdef MADV_NOHUGEPAGE
  // Otherwise the first byte of a column may take a large page. ReservedMemory asks for them where they are used.
  madvise(data, bytes, MADV_NOHUGEPAGE);
#endif
  return {data, writable};
}

bool commit_pages(std::byte* address, std::size_t bytes) {
  return mprotect(address, bytes, PROT_READ | PROT_WRITE) == 0;
}

void release_pages(std::byte* address, std::size_t bytes) { munmap(address, bytes); }

void prefer_large_pages([[maybe_unused]] std::byte* address, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  madvise(address, bytes, MADV_HUGEPAGE);
#endif
}

void join_small_pages([[maybe_unused]] std::byte* address, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_COLLAPSE
  madvise(address, bytes, MADV_COLLAPSE);
#endif
}

}  // namespace gloam
