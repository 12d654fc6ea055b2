// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/uploads/range_allocator.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

/// Length of the longest run of false.
std::uint64_t longest_free(const std::vector<bool>& used) {
  std::uint64_t longest = 0, run = 0;
  for (const bool unit : used) longest = std::max(longest, run = unit ? 0 : run + 1);
  return longest;
}

TEST(RangeAllocator, ranges_never_overlap_and_every_free_unit_can_be_found) {
  std::mt19937 engine(7);
  const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
  RangeAllocator allocator;
  std::vector<bool> used;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;
  for (int step = 0; step < 20000; ++step) {
    const std::uint32_t action = random() % 100;
    if (action < 2) {
      used.resize(used.size() + random() % 40, false);
      allocator.grow(used.size());
    } else if (action < 55) {
      const std::uint64_t count = 1 + random() % 12;
      const auto first = allocator.allocate(count);
      ASSERT_EQ(first.has_value(), longest_free(used) >= count) << "step " << step;
      if (!first) continue;
      for (std::uint64_t i = *first; i < *first + count; ++i) {
        ASSERT_LT(i, used.size());
        ASSERT_FALSE(used[i]) << "step " << step;
        used[i] = true;
      }
      ranges.emplace_back(*first, count);
    } else if (!ranges.empty()) {
      std::swap(ranges[random() % ranges.size()], ranges.back());
      const auto [first, count] = ranges.back();
      ranges.pop_back();
      allocator.free(first, count);
      std::fill_n(used.begin() + static_cast<std::ptrdiff_t>(first), count, false);
    }
    ASSERT_EQ(allocator.used(), static_cast<std::uint64_t>(std::ranges::count(used, true)));
    const auto last = std::find(used.rbegin(), used.rend(), true);
    ASSERT_EQ(allocator.free_at_end(), static_cast<std::uint64_t>(last - used.rbegin()));
  }
  EXPECT_GT(used.size(), 1000u);
}

TEST(RangeAllocator, a_range_is_freed_once) {
  RangeAllocator allocator;
  allocator.grow(8);
  const std::uint64_t first = allocator.allocate(4).value();
  allocator.free(first, 4);
  EXPECT_ASSERT(allocator.free(first, 4), "only allocated ranges are freed");
  static_cast<void>(allocator.allocate(4));
  const std::uint64_t other = allocator.allocate(4).value();
  allocator.free(other, 4);
  EXPECT_ASSERT(allocator.free(other, 2), "a range is freed once");
}

}  // namespace
}  // namespace gloam
