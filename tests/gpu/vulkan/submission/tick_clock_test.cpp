// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/gpu/vulkan/submission/tick_clock.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace gloam::gpu::vulkan {
namespace {

// Hard case: passes.timestamps
TEST(TickClock, keeps_single_ticks_of_a_clock_that_has_run_for_years) {
  for (const std::uint64_t start : {std::uint64_t{1} << 54, (std::uint64_t{1} << 60) + 1, ~std::uint64_t{0} - 10}) {
    TickClock clock(64, 1.0);
    const std::uint64_t first = clock.nanoseconds(start);
    EXPECT_EQ(clock.nanoseconds(start + 1) - first, 1u) << start;
    EXPECT_EQ(clock.nanoseconds(start + 8) - first, 8u) << start;
  }
}

TEST(TickClock, multiplies_by_the_period) {
  TickClock clock(64, 52.0833320617675781);  // 19.2 MHz
  const std::uint64_t first = clock.nanoseconds(std::uint64_t{1} << 55);
  EXPECT_EQ(clock.nanoseconds((std::uint64_t{1} << 55) + 19'200'000) - first, 999'999'976u);  // a second, to a float
}

// Hard case: passes.timestamps
TEST(TickClock, goes_on_where_the_counter_wraps_around) {
  for (const std::uint32_t bits : {36u, 40u, 64u}) {
    TickClock clock(bits, 2.0);
    const std::uint64_t end = bits == 64 ? 0 : std::uint64_t{1} << bits;
    const std::uint64_t first = clock.nanoseconds(end - 10);
    EXPECT_EQ(clock.nanoseconds(5) - first, 30u) << bits;
    EXPECT_EQ(clock.nanoseconds(105) - first, 230u) << bits;
  }
}

TEST(TickClock, does_not_look_at_bits_that_are_not_valid) {
  TickClock clock(36, 1.0);
  const std::uint64_t first = clock.nanoseconds(1000);
  EXPECT_EQ(clock.nanoseconds((std::uint64_t{0xABCDEF} << 36) + 1007) - first, 7u);
}

TEST(TickClock, takes_frames_in_any_order) {
  TickClock clock(36, 1.0);
  const std::uint64_t later = clock.nanoseconds(5000);
  const std::uint64_t earlier = clock.nanoseconds(4000);
  EXPECT_EQ(later - earlier, 1000u);
  EXPECT_GT(earlier, 0u);
  EXPECT_EQ(clock.nanoseconds(6000) - later, 1000u);
}

TEST(TickClock, of_a_queue_without_timestamps_says_0) {
  TickClock clock(0, 1.0);
  EXPECT_EQ(clock.nanoseconds(12345), 0u);
}

}  // namespace
}  // namespace gloam::gpu::vulkan
