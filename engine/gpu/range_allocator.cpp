// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/range_allocator.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "engine/core/assert.h"

namespace gloam::gpu {

RangeAllocator::RangeAllocator(std::uint64_t size) : size_(size) {
  if (size > 0) free_.emplace(0, size);
}

std::optional<std::uint64_t> RangeAllocator::allocate(std::uint64_t size, std::uint64_t alignment) {
  GLOAM_ASSERT(size > 0, "a range holds at least one byte");
  GLOAM_ASSERT(std::has_single_bit(alignment), "an alignment is a power of two");
  const auto aligned = [&](std::uint64_t offset) { return (offset + alignment - 1) & ~(alignment - 1); };
  auto best = free_.end();
  for (auto it = free_.begin(); it != free_.end(); ++it) {
    const std::uint64_t padding = aligned(it->first) - it->first;
    const bool fits = it->second >= padding && it->second - padding >= size;
    if (fits && (best == free_.end() || it->second < best->second)) best = it;
  }
  if (best == free_.end()) return std::nullopt;

  const std::uint64_t begin = best->first;
  const std::uint64_t end = begin + best->second;
  const std::uint64_t offset = aligned(begin);
  free_.erase(best);
  if (offset > begin) free_.emplace(begin, offset - begin);
  if (offset + size < end) free_.emplace(offset + size, end - offset - size);
  used_.emplace(offset, size);
  used_bytes_ += size;
  return offset;
}

void RangeAllocator::free(std::uint64_t offset) {
  const auto used = used_.find(offset);
  GLOAM_ASSERT(used != used_.end(), "only a range that was handed out can be freed");
  std::uint64_t size = used->second;
  used_bytes_ -= size;
  used_.erase(used);

  auto next = free_.lower_bound(offset);
  if (next != free_.end() && offset + size == next->first) {
    size += next->second;
    next = free_.erase(next);
  }
  if (next != free_.begin()) {
    const auto previous = std::prev(next);
    if (previous->first + previous->second == offset) {
      previous->second += size;
      return;
    }
  }
  free_.emplace(offset, size);
}

std::uint64_t RangeAllocator::largest_free() const {
  std::uint64_t largest = 0;
  for (const auto& [offset, size] : free_) largest = std::max(largest, size);
  return largest;
}

}  // namespace gloam::gpu
