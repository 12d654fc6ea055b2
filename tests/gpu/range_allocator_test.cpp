// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/range_allocator.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <random>

#include "tests/support/expect_assert.h"

namespace gloam::gpu {
namespace {

TEST(RangeAllocator, hands_out_aligned_ranges_inside_its_span) {
  RangeAllocator ranges(1000);
  EXPECT_EQ(ranges.allocate(10, 1), 0u);
  EXPECT_EQ(ranges.allocate(10, 256), 256u);
  EXPECT_EQ(ranges.allocate(246, 1), 10u);  // the gap before the aligned range is not lost
  EXPECT_EQ(ranges.used_bytes(), 266u);
}

TEST(RangeAllocator, says_none_when_no_free_range_is_large_enough) {
  RangeAllocator ranges(100);
  EXPECT_EQ(ranges.allocate(101, 1), std::nullopt);
  EXPECT_EQ(ranges.allocate(60, 1), 0u);
  EXPECT_EQ(ranges.allocate(41, 1), std::nullopt);
  EXPECT_EQ(ranges.allocate(37, 64), std::nullopt);
  EXPECT_EQ(ranges.allocate(36, 64), 64u);
}

TEST(RangeAllocator, merges_freed_neighbours_whatever_the_order) {
  RangeAllocator ranges(30);
  for (int i = 0; i < 3; ++i) (void)ranges.allocate(10, 1);
  ranges.free(0);
  ranges.free(20);
  ranges.free(10);
  EXPECT_TRUE(ranges.empty());
  EXPECT_EQ(ranges.largest_free(), 30u);
}

TEST(RangeAllocator, takes_the_smallest_range_that_fits) {
  RangeAllocator ranges(100);
  (void)ranges.allocate(20, 1);  // 0: freed, 20 bytes
  (void)ranges.allocate(10, 1);  // 20
  (void)ranges.allocate(12, 1);  // 30: freed, 12 bytes
  (void)ranges.allocate(58, 1);  // 42 … 100
  ranges.free(0);
  ranges.free(30);
  EXPECT_EQ(ranges.allocate(11, 1), 30u);
}

TEST(RangeAllocator, asserts_on_a_range_that_it_did_not_hand_out) {
  RangeAllocator ranges(16);
  (void)ranges.allocate(8, 1);
  EXPECT_ASSERT(ranges.free(4), "handed out");
}

TEST(RangeAllocator, never_overlaps_and_always_comes_back_to_one_free_range) {
  std::mt19937 random(7);
  RangeAllocator ranges(1 << 16);
  std::map<std::uint64_t, std::uint64_t> live;
  for (int step = 0; step < 5000; ++step) {
    if (live.empty() || random() % 5 < 3) {
      const std::uint64_t size = 1 + random() % 3000;
      const std::uint64_t alignment = 1ull << (random() % 9);
      const auto offset = ranges.allocate(size, alignment);
      if (!offset) continue;
      ASSERT_EQ(*offset % alignment, 0u);
      ASSERT_LE(*offset + size, ranges.size());
      const auto next = live.lower_bound(*offset);
      if (next != live.end()) {
        ASSERT_LE(*offset + size, next->first);
      }
      if (next != live.begin()) {
        ASSERT_LE(std::prev(next)->first + std::prev(next)->second, *offset);
      }
      live.emplace(*offset, size);
    } else {
      const auto victim = std::next(live.begin(), static_cast<std::ptrdiff_t>(random() % live.size()));
      ranges.free(victim->first);
      live.erase(victim);
    }
  }
  for (const auto& [offset, size] : live) ranges.free(offset);
  EXPECT_EQ(ranges.largest_free(), ranges.size());
  EXPECT_EQ(ranges.used_bytes(), 0u);
}

}  // namespace
}  // namespace gloam::gpu
