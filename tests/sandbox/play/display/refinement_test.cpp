// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/display/refinement.h"

#include <gtest/gtest.h>

namespace gloam {
namespace {

using Next = Refinement::Next;

constexpr double kTurnS = 0.1;

Next step(Refinement& refinement, double moment, bool active = false) {
  const Next next = refinement.next({.numbers = {moment}, .visualizer = "none"}, kTurnS, active);
  if (next == Next::full) refinement.shown_full();
  return next;
}

TEST(Refinement, draws_at_full_size_after_a_rest_and_then_keeps_the_picture) {
  Refinement refinement;
  EXPECT_EQ(step(refinement, 1.0), Next::reduced) << "a moment begins";
  EXPECT_EQ(step(refinement, 1.0), Next::reduced) << "0.1 s";
  EXPECT_EQ(step(refinement, 1.0), Next::reduced) << "0.2 s";
  EXPECT_FALSE(refinement.refined());
  for (std::uint32_t i = 0; i < Refinement::kFullFrames; ++i) EXPECT_EQ(step(refinement, 1.0), Next::full);
  EXPECT_TRUE(refinement.refined());
  for (int i = 0; i < 100; ++i) EXPECT_EQ(step(refinement, 1.0), Next::kept);
}

TEST(Refinement, draws_as_many_full_frames_as_an_accumulated_picture_takes) {
  Refinement refinement;
  const auto next = [&] {
    const Next said = refinement.next({.numbers = {1.0}, .visualizer = "none"}, kTurnS, false, 16);
    if (said == Next::full) refinement.shown_full();
    return said;
  };
  int full = 0;
  for (int i = 0; i < 40; ++i) full += next() == Next::full ? 1 : 0;
  EXPECT_EQ(full, 16);
  EXPECT_EQ(next(), Next::kept);
}

TEST(Refinement, returns_to_the_reduced_scale_in_the_frame_in_which_something_moves) {
  Refinement refinement;
  for (int i = 0; i < 20; ++i) step(refinement, 1.0);
  EXPECT_EQ(step(refinement, 2.0), Next::reduced);
  EXPECT_FALSE(refinement.refined());
}

TEST(Refinement, a_moving_camera_is_never_refined) {
  Refinement refinement;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(step(refinement, i), Next::reduced);
}

TEST(Refinement, draws_nothing_while_the_pointer_moves_over_a_refined_picture) {
  Refinement refinement;
  for (int i = 0; i < 4; ++i) step(refinement, 1.0);
  ASSERT_TRUE(refinement.refined());
  for (int i = 0; i < 10; ++i) EXPECT_EQ(step(refinement, 1.0, true), Next::kept);
  EXPECT_EQ(step(refinement, 1.0), Next::kept) << "0.1 s after the last movement";
  EXPECT_EQ(step(refinement, 1.0), Next::kept);
  EXPECT_EQ(step(refinement, 1.0), Next::full) << "the effects that accumulate go on";
}

TEST(Refinement, a_moving_pointer_delays_the_first_full_picture) {
  Refinement refinement;
  for (int i = 0; i < 10; ++i) EXPECT_EQ(step(refinement, 1.0, true), Next::reduced);
}

TEST(Refinement, a_frame_that_was_not_shown_is_drawn_again) {
  Refinement refinement;
  for (int i = 0; i < 10; ++i) static_cast<void>(refinement.next({.numbers = {1.0}, .visualizer = {}}, kTurnS, false));
  EXPECT_FALSE(refinement.refined());
}

TEST(Refinement, a_restart_waits_for_a_rest) {
  Refinement refinement;
  for (int i = 0; i < 20; ++i) step(refinement, 1.0);
  refinement.restart();
  EXPECT_EQ(step(refinement, 1.0), Next::reduced);
}

}  // namespace
}  // namespace gloam
