// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/budget/exact_timing.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

constexpr double kFrameS = 0.1;

/// Frames that show the same moment. Returns how many of them draw the exact picture.
std::uint32_t stand(ExactTiming& timing, double moment, int frames) {
  std::uint32_t drawn = 0;
  for (int frame = 0; frame < frames; ++frame) {
    if (!timing.next({.numbers = {moment}, .visualizer = "none"}, kFrameS)) continue;
    ++drawn;
    timing.drawn();
  }
  return drawn;
}

TEST(ExactTiming, draws_the_first_picture_at_once_and_keeps_it) {
  ExactTiming timing;
  EXPECT_FALSE(timing.has_picture());
  EXPECT_EQ(stand(timing, 1.0, 1 + ExactTiming::kFrames), ExactTiming::kFrames);
  EXPECT_TRUE(timing.is_present());
  EXPECT_EQ(stand(timing, 1.0, 100), 0u);
}

TEST(ExactTiming, draws_again_when_a_new_moment_has_stood) {
  ExactTiming timing;
  stand(timing, 1.0, 10);
  EXPECT_EQ(stand(timing, 2.0, 5), 0u) << "0.4 s";
  EXPECT_TRUE(timing.has_picture());
  EXPECT_FALSE(timing.is_present()) << "of an earlier moment";
  EXPECT_EQ(stand(timing, 2.0, 10), ExactTiming::kFrames);
  EXPECT_TRUE(timing.is_present());
}

TEST(ExactTiming, draws_nothing_while_things_move) {
  ExactTiming timing;
  for (int moment = 0; moment < 100; ++moment) EXPECT_EQ(stand(timing, moment, 1), 0u);
  EXPECT_EQ(stand(timing, 100.0, 3), 2u);
  EXPECT_EQ(stand(timing, 101.0, 2), 1u) << "the frames before were of another moment";
  EXPECT_FALSE(timing.has_picture());
  EXPECT_TRUE(stand(timing, 101.0, 10) == 2u && timing.is_present());
}

TEST(ExactTiming, a_moment_that_returns_needs_no_new_picture) {
  ExactTiming timing;
  stand(timing, 1.0, 10);
  stand(timing, 2.0, 2);
  EXPECT_EQ(stand(timing, 1.0, 20), 0u);
  EXPECT_TRUE(timing.is_present());
  EXPECT_FALSE(timing.next({.numbers = {1.0}, .visualizer = "albedo"}, kFrameS));
  EXPECT_FALSE(timing.is_present()) << "another visualizer";
}

}  // namespace
}  // namespace gloam
