// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/storage/virtual_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <new>

// POSIX: mmap, mprotect and munmap. Their equivalents on Windows are VirtualAlloc with MEM_RESERVE, VirtualAlloc with
// MEM_COMMIT, and VirtualFree.
//
// A process has a limited number of mappings (vm.max_map_count on Linux, 65,530 by default), and pages of different
// protection are different mappings. So a reservation is writable as a whole: it takes memory only where it is written
// to, and neighbouring reservations are one mapping. Where the system counts writable pages that were never written to
// against a limit (vm.overcommit_memory=2, RLIMIT_DATA), pages become writable when they are committed.

namespace gloam {
namespace {

/// The system refused address space or memory.
class OutOfMemory : public std::bad_alloc {
 public:
  [[nodiscard]] const char* what() const noexcept override {
    return "the system gives no more memory for components: its address space, its number of mappings "
           "(vm.max_map_count) or its memory, or that of the host's allocator, is used up";
  }
};

void* map_pages(std::size_t bytes, int protection) {
  return mmap(nullptr, bytes, protection, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
}

}  // namespace

std::size_t ReservedMemory::page_size() {
  static const auto size = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return size;
}

ReservedMemory::ReservedMemory(std::size_t bytes, CpuAllocator* allocator)
    : bytes_(round_up(bytes, bytes >= kLargePage && allocator == nullptr ? kLargePage : page_size())),
      allocator_(allocator) {
  if (allocator != nullptr) {
    data_ = static_cast<std::byte*>(allocator->allocate(bytes_, page_size()));
    if (data_ == nullptr) throw OutOfMemory();
    return;
  }
  const std::size_t slack = bytes_ >= kLargePage ? kLargePage : 0;
  void* address = map_pages(bytes_ + slack, PROT_READ | PROT_WRITE);
  writable_ = address != MAP_FAILED;
  if (!writable_) address = map_pages(bytes_ + slack, PROT_NONE);
  if (address == MAP_FAILED) throw OutOfMemory();
  data_ = static_cast<std::byte*>(address);
  if (slack > 0) {
    // As far back as it can be: Linux maps downwards, so the reservation then touches the one before, as one mapping.
    const std::size_t after = (reinterpret_cast<std::uintptr_t>(address) + bytes_ + slack) % kLargePage;
    const std::size_t before = slack - after;
    if (before > 0) munmap(data_, before);
    data_ += before;
    if (after > 0) munmap(data_ + bytes_, after);
  }
#ifdef MADV_NOHUGEPAGE
  // Otherwise the first byte of a column may take a large page. extend() asks for them where they are used.
  madvise(data_, bytes_, MADV_NOHUGEPAGE);
#endif
}

ReservedMemory::~ReservedMemory() {
  if (data_ == nullptr) return;
  if (allocator_ != nullptr)
    allocator_->free(data_, bytes_, page_size());
  else
    munmap(data_, bytes_);
}

void ReservedMemory::commit(std::size_t begin, std::size_t end) {
  GLOAM_ASSERT(begin <= end && end <= bytes_, "pages are committed within their reservation");
  GLOAM_ASSERT(begin % page_size() == 0 && end % page_size() == 0, "memory is committed by whole pages");
  if (begin == end || writable_) return;
  if (allocator_ != nullptr) {
    std::memset(data_ + begin, 0, end - begin);
    return;
  }
  if (mprotect(data_ + begin, end - begin, PROT_READ | PROT_WRITE) != 0) throw OutOfMemory();
}

void ReservedMemory::extend(Stretch& stretch, std::size_t end) {
  if (end <= stretch.committed) return;
  const std::size_t large = stretch.begin + kLargePage;
  const bool by_large_pages = allocator_ == nullptr && end - stretch.begin >= kLargePage / 2 && large <= stretch.limit;
  const std::size_t old_end = stretch.committed;
  const std::size_t new_end =
      std::min(stretch.begin + round_up(end - stretch.begin, by_large_pages ? kLargePage : page_size()), stretch.limit);
  commit(old_end, new_end);
  stretch.committed = new_end;
#ifdef MADV_HUGEPAGE
  if (by_large_pages) madvise(data_ + stretch.begin, new_end - stretch.begin, MADV_HUGEPAGE);
#endif
#ifdef MADV_COLLAPSE
  // Bytes after the first large page get large pages on their first touch. The first one was touched page by page.
  if (old_end < large && large <= new_end) madvise(data_ + stretch.begin, kLargePage, MADV_COLLAPSE);
#endif
}

std::byte* PackedMemory::take(std::size_t bytes) {
  constexpr std::size_t kAlignment = 64;
  constexpr std::size_t kStep = std::size_t{64} << 10;
  constexpr std::size_t kBlock = std::size_t{64} << 20;
  constexpr std::size_t kBlockOfHost = std::size_t{256} << 10;  // is not only address space
  bytes = round_up(bytes, kAlignment);
  if (blocks_.empty() || bytes > blocks_.back().memory.size() - used_) {
    ReservedMemory memory(std::max(allocator_ == nullptr ? kBlock : kBlockOfHost, bytes), allocator_);
    const std::size_t size = memory.size();
    blocks_.push_back({std::move(memory), {.limit = size}});
    used_ = 0;
  }
  Block& block = blocks_.back();
  std::byte* const piece = block.memory.data() + used_;
  used_ += bytes;
  block.memory.extend(block.stretch, std::min(round_up(used_, kStep), block.memory.size()));
  return piece;
}

}  // namespace gloam
