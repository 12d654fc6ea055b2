// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/core/range_allocator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

/// The range that best fit takes from a bitmap of used units: of all free runs that hold an aligned range, the
/// shortest, and of these the first.
std::optional<std::uint64_t> best_fit(const std::vector<bool>& used, std::uint64_t count, std::uint64_t alignment) {
  std::optional<std::uint64_t> best;
  std::uint64_t best_length = 0;
  for (std::uint64_t begin = 0; begin < used.size();) {
    if (used[begin]) {
      ++begin;
      continue;
    }
    std::uint64_t end = begin;
    while (end < used.size() && !used[end]) ++end;
    std::uint64_t first = begin;
    while (first % alignment != 0) ++first;
    if (first + count <= end && (!best || end - begin < best_length)) {
      best = first;
      best_length = end - begin;
    }
    begin = end;
  }
  return best;
}

TEST(RangeAllocator, allocates_as_best_fit_in_a_bitmap_does) {
  std::mt19937 engine(7);
  const auto random = [&] { return static_cast<std::uint32_t>(engine()); };
  RangeAllocator allocator;
  std::vector<bool> used;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> ranges;
  int allocated = 0, refused = 0;
  for (int step = 0; step < 20000; ++step) {
    const std::uint32_t action = random() % 100;
    if (action < 2) {
      used.resize(used.size() + random() % 40, false);
      allocator.grow(used.size());
    } else if (action < 55) {
      const std::uint64_t count = 1 + random() % 12;
      const std::uint64_t alignment = random() % 2 == 0 ? 1 : std::uint64_t{1} << (random() % 6);
      const auto first = allocator.allocate(count, alignment);
      ASSERT_EQ(first, best_fit(used, count, alignment)) << "step " << step;
      ++(first ? allocated : refused);
      if (!first) continue;
      std::fill_n(used.begin() + static_cast<std::ptrdiff_t>(*first), count, true);
      ranges.emplace_back(*first, count);
    } else if (!ranges.empty()) {
      std::swap(ranges[random() % ranges.size()], ranges.back());
      const auto [first, count] = ranges.back();
      ranges.pop_back();
      allocator.free(first);
      std::fill_n(used.begin() + static_cast<std::ptrdiff_t>(first), count, false);
    }
    ASSERT_EQ(allocator.capacity(), used.size());
    ASSERT_EQ(allocator.used(), static_cast<std::uint64_t>(std::ranges::count(used, true)));
    ASSERT_EQ(allocator.empty(), ranges.empty());
    const auto last = std::find(used.rbegin(), used.rend(), true);
    ASSERT_EQ(allocator.free_at_end(), static_cast<std::uint64_t>(last - used.rbegin()));
  }
  EXPECT_GT(used.size(), 1000u);
  EXPECT_GT(allocated, 5000);
  EXPECT_GT(refused, 20);
  for (const auto& [first, count] : ranges) allocator.free(first);
  EXPECT_EQ(allocator.free_at_end(), allocator.capacity()) << "all free ranges are one again";
}

TEST(RangeAllocator, keeps_the_gap_before_an_aligned_range) {
  RangeAllocator ranges(1000);
  EXPECT_EQ(ranges.allocate(10), 0u);
  EXPECT_EQ(ranges.allocate(10, 256), 256u);
  EXPECT_EQ(ranges.allocate(246), 10u);
  EXPECT_EQ(ranges.used(), 266u);
}

TEST(RangeAllocator, returns_none_when_no_free_range_is_large_enough) {
  RangeAllocator ranges(100);
  EXPECT_EQ(ranges.allocate(101), std::nullopt);
  EXPECT_EQ(ranges.allocate(60), 0u);
  EXPECT_EQ(ranges.allocate(41), std::nullopt);
  EXPECT_EQ(ranges.allocate(37, 64), std::nullopt);
  EXPECT_EQ(ranges.allocate(36, 64), 64u);
}

TEST(RangeAllocator, takes_the_smallest_range_that_fits) {
  RangeAllocator ranges(100);
  static_cast<void>(ranges.allocate(20));  // 0: freed, 20 units
  static_cast<void>(ranges.allocate(10));  // 20
  static_cast<void>(ranges.allocate(12));  // 30: freed, 12 units
  static_cast<void>(ranges.allocate(58));  // 42 … 100
  ranges.free(0);
  ranges.free(30);
  EXPECT_EQ(ranges.allocate(11), 30u);
}

TEST(RangeAllocator, large_numbers_do_not_overflow) {
  constexpr std::uint64_t kMost = ~std::uint64_t{0};
  RangeAllocator ranges(kMost);
  EXPECT_EQ(ranges.allocate(1), 0u);
  EXPECT_EQ(ranges.allocate(kMost), std::nullopt);
  EXPECT_EQ(ranges.allocate(1, std::uint64_t{1} << 63), std::uint64_t{1} << 63);
  EXPECT_EQ(ranges.allocate(1, std::uint64_t{1} << 63), std::nullopt);
}

TEST(RangeAllocator, only_allocated_ranges_are_freed_and_only_once) {
  RangeAllocator ranges(16);
  const std::uint64_t first = ranges.allocate(8).value();
  EXPECT_ASSERT(ranges.free(first + 4), "only a range that was allocated is freed");
  EXPECT_ASSERT(ranges.free(12), "only a range that was allocated is freed");
  ranges.free(first);
  EXPECT_ASSERT(ranges.free(first), "and only once");
}

TEST(RangeAllocator, a_range_has_units_and_an_alignment_is_a_power_of_two) {
  RangeAllocator ranges(16);
  EXPECT_ASSERT(static_cast<void>(ranges.allocate(0)), "at least one unit");
  EXPECT_ASSERT(static_cast<void>(ranges.allocate(1, 0)), "power of two");
  EXPECT_ASSERT(static_cast<void>(ranges.allocate(1, 3)), "power of two");
  EXPECT_ASSERT(ranges.grow(15), "never shrinks");
}

}  // namespace
}  // namespace gloam
