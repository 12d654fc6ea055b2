// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/simulation/steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "shaders/grass/grass_shared.h"

namespace gloam::test {
namespace {

// Hard case: grass.dt_0, grass.dt_nan, further.denormals
TEST(GrassSteps, no_time_and_no_number_make_no_step) {
  StepClock clock;
  for (const double dt : {0.0, -0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                          -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::denorm_min()}) {
    clock.advance(dt);
    EXPECT_EQ(clock.frame_steps(), 0u) << dt;
    EXPECT_EQ(clock.now(), 0u) << dt;
    EXPECT_LT(clock.remainder_s(), 1e-12);
  }
}

// Hard case: grass.dt_1s, grass.dt_10s
TEST(GrassSteps, long_frames_are_bounded_and_owe_nothing) {
  for (const double dt : {1.0, 10.0, 1e300, std::numeric_limits<double>::infinity()}) {
    StepClock clock;
    clock.advance(0.004);
    clock.advance(dt);
    EXPECT_EQ(clock.frame_steps(), kMostGrassSteps) << dt;
    EXPECT_EQ(clock.remainder_s(), 0.0) << dt;
    EXPECT_EQ(clock.now(), kMostGrassSteps);
    clock.advance(0.0);
    EXPECT_EQ(clock.frame_steps(), 0u);
  }
}

// Hard case: grass.dt_1us
TEST(GrassSteps, short_frames_add_up) {
  StepClock clock;
  std::uint32_t steps = 0;
  for (int i = 0; i < 1000000; ++i) {
    clock.advance(1e-6);
    EXPECT_LE(clock.frame_steps(), 1u);
    steps += clock.frame_steps();
  }
  EXPECT_NEAR(steps, 120, 1);
  EXPECT_EQ(clock.now(), steps);
}

TEST(GrassSteps, frames_of_whole_steps_lose_none) {
  StepClock clock;
  for (int i = 0; i < 10000; ++i) {
    clock.advance(1.0 / 60.0);
    ASSERT_EQ(clock.frame_steps(), 2u) << i;
    EXPECT_EQ(steps_between(clock.first_step(), clock.now()), 2u);
    EXPECT_GE(clock.remainder_s(), 0.0);
  }
}

// Hard case: selftest.frame_time
TEST(GrassSteps, any_frame_rate_gives_as_many_steps_a_second) {
  for (const double rate : {17.0, 24.0, 59.94, 75.0, 120.0, 144.0, 1000.0}) {
    StepClock clock;
    for (int i = 0; i < static_cast<int>(10.0 * rate); ++i) clock.advance(1.0 / rate);
    EXPECT_NEAR(clock.now(), 120.0 * std::floor(10.0 * rate) / rate, 1.01) << rate;
  }
}

TEST(GrassSteps, the_number_wraps_without_the_value_that_means_none) {
  StepClock clock;
  clock.restart(GLOAM_GRASS_NO_STEP - 3);
  for (int i = 0; i < 12; ++i) {
    clock.advance(kGrassStep);
    EXPECT_NE(clock.now(), GLOAM_GRASS_NO_STEP);
    EXPECT_EQ(steps_between(clock.first_step(), clock.now()), 1u);
  }
  EXPECT_EQ(clock.now(), 9u);
  EXPECT_EQ(steps_between(GLOAM_GRASS_NO_STEP - 3, 9), 12u);
  clock.restart(GLOAM_GRASS_NO_STEP);
  EXPECT_EQ(clock.now(), 0u);
}

// Hard case: further.thirty_days
TEST(GrassSteps, frames_after_thirty_days_have_the_steps_of_the_first) {
  const auto steps_from = [](double start_s) {
    StepClock clock;
    std::vector<std::uint32_t> steps;
    for (int frame = 0; frame < 600; ++frame) {
      const double time_s = start_s + frame / 64.0;
      clock.advance_in(static_cast<std::uint64_t>(frame) + 1, {.time_s = time_s, .dt_s = 1.0 / 64.0});
      steps.push_back(clock.now());
    }
    return steps;
  };
  EXPECT_EQ(steps_from(30.0 * 86400.0), steps_from(0.0));
}

// Hard case: further.time_backwards
TEST(GrassSteps, time_that_runs_backwards_starts_again_in_each_frame) {
  StepClock clock;
  clock.advance_in(1, {.time_s = 9.0, .dt_s = 1.0 / 60.0});
  std::uint32_t restarts = clock.restarts();
  for (std::uint64_t frame = 2; frame < 50; ++frame) {
    clock.advance_in(frame, {.time_s = 9.0 - 0.1 * static_cast<double>(frame), .dt_s = 1.0 / 60.0});
    EXPECT_EQ(clock.restarts(), ++restarts) << frame;
    EXPECT_LE(clock.now(), kMostGrassSteps) << frame;
  }
}

TEST(GrassSteps, a_frame_at_the_time_of_the_last_one_has_its_steps) {
  StepClock clock;
  clock.advance_in(1, {.time_s = 2.0, .dt_s = 1.0 / 60.0});
  clock.advance_in(2, {.time_s = 2.02, .dt_s = 0.02});
  const StepClock last = clock;
  for (const double dt_s : {0.02, 0.0, 1.0}) {
    for (std::uint64_t frame = 3; frame < 6; ++frame) clock.advance_in(frame, {.time_s = 2.02, .dt_s = dt_s});
    EXPECT_EQ(clock.now(), last.now()) << dt_s;
    EXPECT_EQ(clock.first_step(), last.first_step()) << dt_s;
    EXPECT_EQ(clock.frame_steps(), last.frame_steps()) << dt_s;
    EXPECT_EQ(clock.remainder_s(), last.remainder_s()) << dt_s;
  }
  clock.advance_in(7, {.time_s = 2.02 + kGrassStep, .dt_s = kGrassStep});
  EXPECT_EQ(clock.first_step(), last.now());
  EXPECT_EQ(clock.frame_steps(), 1u);
  EXPECT_EQ(clock.restarts(), 0u);
}

TEST(GrassSteps, the_same_frame_has_its_steps_at_any_time) {
  StepClock clock;
  clock.advance_in(1, {.time_s = 0.0, .dt_s = 1.0 / 60.0});
  clock.advance_in(1, {.time_s = 0.5, .dt_s = 1.0 / 60.0});
  clock.advance_in(1, {.time_s = -0.5, .dt_s = 1.0 / 60.0});
  EXPECT_EQ(clock.now(), 2u);
  EXPECT_EQ(clock.restarts(), 0u);
}

TEST(GrassSteps, a_sequence_of_frames_has_the_same_steps_each_time) {
  StepClock clock;
  std::vector<std::uint32_t> first;
  std::uint64_t number = 0;
  for (std::uint32_t turn = 0; turn < 3; ++turn) {
    std::vector<std::uint32_t> steps;
    for (int frame = 0; frame < 10; ++frame) {
      clock.advance_in(number++, {.time_s = 1.0 + 0.013 * frame, .dt_s = 0.013});
      steps.insert(steps.end(), {clock.first_step(), clock.frame_steps(), clock.now()});
    }
    if (turn == 0) first = steps;
    EXPECT_EQ(steps, first) << "turn " << turn;
    EXPECT_EQ(clock.restarts(), turn);
  }
}

TEST(GrassSteps, a_time_that_is_no_number_advances_by_the_duration) {
  StepClock clock;
  for (std::uint64_t frame = 0; frame < 3; ++frame)
    clock.advance_in(frame, {.time_s = std::numeric_limits<double>::quiet_NaN(), .dt_s = kGrassStep});
  EXPECT_EQ(clock.now(), 3u);
  EXPECT_EQ(clock.restarts(), 0u);
}

}  // namespace
}  // namespace gloam::test
