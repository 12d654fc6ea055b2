// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/wipe/side_timing.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

constexpr double kFrameS = 0.1;

/// Frames that show the same moment. Returns how many of them draw the exact picture.
std::uint32_t stand(SideTiming& timing, double moment, int frames) {
  std::uint32_t drawn = 0;
  for (int frame = 0; frame < frames; ++frame) {
    if (!timing.next({.numbers = {moment}, .visualizer = "none"}, kFrameS)) continue;
    ++drawn;
    timing.drawn();
  }
  return drawn;
}

TEST(SideTiming, draws_the_first_picture_at_once_and_keeps_it) {
  SideTiming timing;
  EXPECT_FALSE(timing.has_picture());
  EXPECT_EQ(stand(timing, 1.0, 1 + SideTiming::kFrames), SideTiming::kFrames);
  EXPECT_TRUE(timing.is_present());
  EXPECT_EQ(stand(timing, 1.0, 100), 0u);
}

TEST(SideTiming, draws_again_when_a_new_moment_has_stood) {
  SideTiming timing;
  stand(timing, 1.0, 10);
  EXPECT_EQ(stand(timing, 2.0, 5), 0u) << "0.4 s";
  EXPECT_TRUE(timing.has_picture());
  EXPECT_FALSE(timing.is_present()) << "of an earlier moment";
  EXPECT_EQ(stand(timing, 2.0, 10), SideTiming::kFrames);
  EXPECT_TRUE(timing.is_present());
}

TEST(SideTiming, draws_nothing_while_things_move) {
  SideTiming timing;
  for (int moment = 0; moment < 100; ++moment) EXPECT_EQ(stand(timing, moment, 1), 0u);
  EXPECT_EQ(stand(timing, 100.0, 3), 2u);
  EXPECT_EQ(stand(timing, 101.0, 2), 1u) << "the frames before were of another moment";
  EXPECT_FALSE(timing.has_picture());
  EXPECT_TRUE(stand(timing, 101.0, 10) == 2u && timing.is_present());
}

TEST(SideTiming, at_the_pace_always_each_moving_frame_is_drawn_and_shown_until_it_settles) {
  SideTiming timing(SideTiming::Pace::always);
  EXPECT_TRUE(timing.next({.numbers = {0.0}, .visualizer = "none"}, kFrameS));
  EXPECT_TRUE(timing.begins()) << "there is no older picture";
  EXPECT_TRUE(timing.drawn()) << "shown at once";
  for (int moment = 1; moment < 20; ++moment) EXPECT_EQ(stand(timing, moment, 1), 1u);
  EXPECT_TRUE(timing.is_present());
  EXPECT_FALSE(timing.begins()) << "contents kept from the frame before are of use";
  EXPECT_EQ(stand(timing, 20.0, 50), SideTiming::kFrames);
  EXPECT_EQ(stand(timing, 21.0, 1), 1u);
}

TEST(SideTiming, a_moment_that_returns_needs_no_new_picture) {
  SideTiming timing;
  stand(timing, 1.0, 10);
  stand(timing, 2.0, 2);
  EXPECT_EQ(stand(timing, 1.0, 20), 0u);
  EXPECT_TRUE(timing.is_present());
  EXPECT_FALSE(timing.next({.numbers = {1.0}, .visualizer = "albedo"}, kFrameS));
  EXPECT_FALSE(timing.is_present()) << "another visualizer";
}

}  // namespace
}  // namespace gloam
