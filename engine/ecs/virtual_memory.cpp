// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/virtual_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <new>

// POSIX. The same three calls on Windows are VirtualAlloc with MEM_RESERVE, VirtualAlloc with MEM_COMMIT, and
// VirtualFree.

namespace gloam {

std::size_t ReservedMemory::page_size() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

ReservedMemory::ReservedMemory(std::size_t bytes) : bytes_(round_up(bytes, page_size())) {
  void* address = mmap(nullptr, bytes_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (address == MAP_FAILED) throw std::bad_alloc();
  data_ = static_cast<std::byte*>(address);
#ifdef MADV_HUGEPAGE
  // Long columns are walked from end to end: large pages save faults on filling and misses on walking. Advice only, and without
  // effect on stretches of which less than a large page is committed.
  madvise(address, bytes_, MADV_HUGEPAGE);
#endif
}

ReservedMemory::~ReservedMemory() {
  if (data_ != nullptr) munmap(data_, bytes_);
}

void ReservedMemory::commit(std::size_t begin, std::size_t end) {
  GLOAM_ASSERT(begin <= end && end <= bytes_, "pages are committed within their reservation");
  GLOAM_ASSERT(begin % page_size() == 0 && end % page_size() == 0, "memory is committed by whole pages");
  if (begin == end) return;
  if (mprotect(data_ + begin, end - begin, PROT_READ | PROT_WRITE) != 0) throw std::bad_alloc();
}

}  // namespace gloam
