// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/range_allocator.h"

#include <algorithm>
#include <bit>
#include <iterator>

#include "engine/core/assert.h"

namespace gloam {

std::optional<std::uint64_t> RangeAllocator::allocate(std::uint64_t count, std::uint64_t alignment) {
  GLOAM_ASSERT(count > 0, "a range has at least one unit");
  GLOAM_ASSERT(std::has_single_bit(alignment), "an alignment is a power of two");
  const auto padding = [&](std::uint64_t first) { return (alignment - first % alignment) % alignment; };
  const auto found = std::find_if(free_by_count_.lower_bound({count, 0}), free_by_count_.end(),
                                  [&](const auto& range) { return range.first - count >= padding(range.second); });
  if (found == free_by_count_.end()) return std::nullopt;
  const auto [free_count, free_first] = *found;
  const std::uint64_t before = padding(free_first);
  const std::uint64_t after = free_count - before - count;
  const std::uint64_t first = free_first + before;
  erase_free(free_.find(free_first));
  if (before > 0) insert_free(free_first, before);
  if (after > 0) insert_free(first + count, after);
  allocated_.emplace(first, count);
  used_ += count;
  return first;
}

void RangeAllocator::free(std::uint64_t first) {
  const auto range = allocated_.find(first);
  GLOAM_ASSERT(range != allocated_.end(), "only a range that was allocated is freed, and only once");
  const std::uint64_t count = range->second;
  allocated_.erase(range);
  used_ -= count;
  add_free(first, count);
}

void RangeAllocator::grow(std::uint64_t capacity) {
  GLOAM_ASSERT(capacity >= capacity_, "a row of units never shrinks");
  if (capacity > capacity_) add_free(capacity_, capacity - capacity_);
  capacity_ = capacity;
}

std::uint64_t RangeAllocator::free_at_end() const {
  if (free_.empty()) return 0;
  const auto last = std::prev(free_.end());
  return last->first + last->second == capacity_ ? last->second : 0;
}

/// Adds a free range and merges it with its free neighbours.
void RangeAllocator::add_free(std::uint64_t first, std::uint64_t count) {
  const auto next = free_.lower_bound(first);
  const auto before = next == free_.begin() ? free_.end() : std::prev(next);
  if (next != free_.end() && next->first == first + count) {
    count += next->second;
    erase_free(next);
  }
  if (before != free_.end() && before->first + before->second == first) {
    first = before->first;
    count += before->second;
    erase_free(before);
  }
  insert_free(first, count);
}

void RangeAllocator::insert_free(std::uint64_t first, std::uint64_t count) {
  free_.emplace(first, count);
  free_by_count_.emplace(count, first);
}

void RangeAllocator::erase_free(Ranges::iterator range) {
  free_by_count_.erase({range->second, range->first});
  free_.erase(range);
}

}  // namespace gloam
