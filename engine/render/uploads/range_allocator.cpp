// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/uploads/range_allocator.h"

#include <iterator>

#include "engine/core/assert.h"

namespace gloam {

std::optional<std::uint64_t> RangeAllocator::allocate(std::uint64_t count) {
  GLOAM_ASSERT(count > 0, "a range has at least one unit");
  const auto found = free_by_count_.lower_bound({count, 0});
  if (found == free_by_count_.end()) return std::nullopt;
  const auto [free_count, first] = *found;
  erase(free_.find(first));
  if (free_count > count) insert(first + count, free_count - count);
  used_ += count;
  return first;
}

void RangeAllocator::free(std::uint64_t first, std::uint64_t count) {
  GLOAM_ASSERT(count > 0 && first + count <= capacity_ && used_ >= count, "only allocated ranges are freed");
  used_ -= count;
  const auto next = free_.lower_bound(first);
  GLOAM_ASSERT(next == free_.end() || next->first >= first + count, "a range is freed once");
  const auto before = next == free_.begin() ? free_.end() : std::prev(next);
  if (next != free_.end() && next->first == first + count) {
    count += next->second;
    erase(next);
  }
  if (before != free_.end()) {
    GLOAM_ASSERT(before->first + before->second <= first, "a range is freed once");
    if (before->first + before->second == first) {
      first = before->first;
      count += before->second;
      erase(before);
    }
  }
  insert(first, count);
}

void RangeAllocator::grow(std::uint64_t capacity) {
  GLOAM_ASSERT(capacity >= capacity_, "a row of units never shrinks");
  const std::uint64_t added = capacity - capacity_;
  const std::uint64_t first = capacity_;
  capacity_ = capacity;
  if (added == 0) return;
  used_ += added;
  free(first, added);
}

std::uint64_t RangeAllocator::free_at_end() const {
  if (free_.empty()) return 0;
  const auto last = std::prev(free_.end());
  return last->first + last->second == capacity_ ? last->second : 0;
}

void RangeAllocator::insert(std::uint64_t first, std::uint64_t count) {
  free_.emplace(first, count);
  free_by_count_.emplace(count, first);
}

void RangeAllocator::erase(std::map<std::uint64_t, std::uint64_t>::iterator range) {
  free_by_count_.erase({range->second, range->first});
  free_.erase(range);
}

}  // namespace gloam
