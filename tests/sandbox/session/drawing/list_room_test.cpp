// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/drawing/list_room.h"

#include <gtest/gtest.h>

#include <vector>

namespace gloam {
namespace {

FrameSample sample_with(double fallback, double overflow = 0.0) {
  FrameSample sample;
  sample.report.counters["shadows.fallback_tiles"] = fallback;
  sample.report.counters["lights.overflow_tiles"] = overflow;
  return sample;
}

/// Draws frames with these numbers of fallback tiles; the last number repeats. Returns how many were drawn.
int drawn_after(double first, const std::vector<double>& later) {
  FrameSample last = sample_with(first);
  int drawn = 0;
  const Status done = draw_until_lists_fit(
      [&]() -> Result<FrameSample> {
        const std::size_t at = std::min<std::size_t>(static_cast<std::size_t>(drawn++), later.size() - 1);
        return sample_with(later[at]);
      },
      last);
  EXPECT_TRUE(done.ok());
  return drawn;
}

TEST(ListRoom, a_frame_whose_lists_fit_is_not_drawn_again) { EXPECT_EQ(drawn_after(0.0, {0.0}), 0); }

TEST(ListRoom, frames_are_drawn_until_no_tile_overflows) {
  EXPECT_EQ(drawn_after(50.0, {50.0, 50.0, 20.0, 20.0, 0.0, 7.0}), 5);
}

TEST(ListRoom, drawing_ends_when_it_does_not_help) {
  EXPECT_EQ(drawn_after(50.0, {50.0}), 3);
  EXPECT_EQ(drawn_after(50.0, {40.0, 60.0}), 4);
}

TEST(ListRoom, tiles_of_light_lists_count_too) {
  FrameSample last = sample_with(0.0, 3.0);
  const Status done = draw_until_lists_fit([]() -> Result<FrameSample> { return sample_with(0.0); }, last);
  EXPECT_TRUE(done.ok());
  EXPECT_EQ(last.report.counters.at("lights.overflow_tiles"), 0.0);
}

TEST(ListRoom, an_error_ends_it) {
  FrameSample last = sample_with(1.0);
  EXPECT_FALSE(draw_until_lists_fit(
                   []() -> Result<FrameSample> {
                     return Error{ErrorKind::failed, "no frame"};
                   },
                   last)
                   .ok());
}

}  // namespace
}  // namespace gloam
