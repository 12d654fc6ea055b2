// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/storage/virtual_memory.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "engine/ecs/storage/system_pages.h"

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

}  // namespace

std::size_t ReservedMemory::page_size() { return system_page_size(); }

ReservedMemory::ReservedMemory(std::size_t bytes, CpuAllocator* allocator)
    : bytes_(round_up(bytes, bytes >= kLargePage && allocator == nullptr ? kLargePage : page_size())),
      allocator_(allocator) {
  if (allocator != nullptr) {
    data_ = static_cast<std::byte*>(allocator->allocate(bytes_, page_size()));
    if (data_ == nullptr) throw OutOfMemory();
    return;
  }
  const ReservedPages pages = reserve_pages(bytes_, bytes_ >= kLargePage ? kLargePage : page_size());
  if (pages.address == nullptr) throw OutOfMemory();
  data_ = pages.address;
  writable_ = pages.writable;
}

ReservedMemory::~ReservedMemory() {
  if (data_ == nullptr) return;
  if (allocator_ != nullptr)
    allocator_->free(data_, bytes_, page_size());
  else
    release_pages(data_, bytes_);
}

void ReservedMemory::commit(std::size_t begin, std::size_t end) {
  GLOAM_ASSERT(begin <= end && end <= bytes_, "pages are committed within their reservation");
  GLOAM_ASSERT(begin % page_size() == 0 && end % page_size() == 0, "memory is committed by whole pages");
  if (begin == end || writable_) return;
  if (allocator_ != nullptr) {
    std::memset(data_ + begin, 0, end - begin);
    return;
  }
  if (!commit_pages(data_ + begin, end - begin)) throw OutOfMemory();
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
  if (by_large_pages) prefer_large_pages(data_ + stretch.begin, new_end - stretch.begin);
  // Bytes after the first large page get large pages on their first touch. The first one was touched page by page.
  if (allocator_ == nullptr && old_end < large && large <= new_end) join_small_pages(data_ + stretch.begin, kLargePage);
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
