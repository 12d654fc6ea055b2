// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/render/governor/machine.h"
#include "tests/render/governor/small_front.h"

// Steps to better points that have failed.

namespace gloam {
namespace {

using test::add;
using test::count;
using test::draw;
using test::Drive;
using test::figures_of;
using test::four_points;
using test::geometric_front;
using test::Machine;
using test::machine_of;
using test::machine_with_heavy_points;

TEST(GovernorStepsTest, a_failed_step_is_taken_back_and_not_tried_again) {
  const std::vector<GovernorPoint> front = four_points();
  Governor governor(front, 50.0);
  const Drive drive = draw(governor, machine_with_heavy_points(front, 2, 1.5), 20000);
  EXPECT_EQ(governor.point(), 1U);
  EXPECT_EQ(count(drive, GovernorReason::over_budget), 1U) << "the start was not a step";
  EXPECT_EQ(count(drive, GovernorReason::fits_again), 1U);
  EXPECT_EQ(count(drive, GovernorReason::step_failed), 1U);
}

TEST(GovernorStepsTest, a_failed_step_is_taken_back_to_the_point_before_it) {
  const std::vector<GovernorPoint> front = geometric_front(9, 10.0, std::sqrt(2.0));
  Machine machine = machine_with_heavy_points(front, 7, 1.25);
  machine.load = [](std::size_t frame, std::size_t) { return frame < 100 ? 1.0 : 0.5; };
  Governor governor(front, 95.0);
  const Drive drive = draw(governor, machine, 400);
  ASSERT_EQ(count(drive, GovernorReason::step_failed), 1U);
  for (const test::DrawnFrame& frame : drive)
    if (frame.decision.reason == GovernorReason::step_failed) {
      EXPECT_EQ(frame.decision.previous, 8U);
      EXPECT_EQ(frame.decision.point, 6U) << "not where the front's times say";
      EXPECT_DOUBLE_EQ(frame.decision.predicted_ms, 40.0) << "as measured before the step";
    }
  EXPECT_EQ(governor.point(), 7U) << "the point between is predicted from both neighbours";
}

TEST(GovernorStepsTest, a_load_that_grows_soon_after_a_step_is_followed_at_once) {
  const std::vector<GovernorPoint> front = geometric_front(9, 10.0, std::sqrt(2.0));
  Machine machine = machine_of(front, 0.5);
  Governor governor(front, 95.0);
  draw(governor, machine, 40);
  ASSERT_EQ(governor.point(), 8U);
  machine = machine_of(front, 2.0);
  const Drive drive = draw(governor, machine, 10);
  EXPECT_EQ(governor.point(), 4U) << "frames take 320 ms: point 6, from which the step was made, would take 160 ms";
  EXPECT_EQ(count(drive, GovernorReason::step_failed), 1U);
  EXPECT_EQ(figures_of(drive, front).changes, 1U);
}

TEST(GovernorStepsTest, a_failed_step_is_tried_again_when_the_view_has_changed) {
  const std::vector<GovernorPoint> front = four_points();
  Machine machine = machine_with_heavy_points(front, 2, 1.5);
  machine.view = [](std::size_t frame) { return frame < 2000 ? 7U : 3U; };
  Governor governor(front, 50.0);
  const Drive drive = draw(governor, machine, 4000);
  EXPECT_EQ(count(drive, GovernorReason::fits_again), 2U) << "once in each view";
  EXPECT_EQ(count(drive, GovernorReason::step_failed), 2U);
  EXPECT_EQ(governor.point(), 1U);
}

TEST(GovernorStepsTest, a_failed_step_is_tried_again_when_the_budget_is_much_higher) {
  const std::vector<GovernorPoint> front = four_points();
  const Machine machine = machine_with_heavy_points(front, 2, 1.5);
  Governor governor(front, 50.0);
  draw(governor, machine, 1000);
  ASSERT_EQ(governor.point(), 1U);
  governor.set_budget(70.0);
  draw(governor, machine, 100);
  EXPECT_EQ(governor.point(), 2U);
}

TEST(GovernorStepsTest, a_view_that_changes_in_every_frame_does_not_make_it_oscillate) {
  const std::vector<GovernorPoint> front = four_points();
  Machine machine = machine_with_heavy_points(front, 2, 1.5);
  machine.view = [](std::size_t frame) { return frame; };
  Governor governor(front, 50.0);
  const test::Figures figures = figures_of(draw(governor, machine, 10000), front);
  // A failed step is tried again 2 s after it has failed: two changes each time.
  EXPECT_LE(static_cast<double>(figures.changes), figures.seconds);
}

TEST(GovernorStepsTest, a_step_that_a_lower_budget_takes_back_has_not_failed) {
  const std::vector<GovernorPoint> front = four_points();
  const Machine machine = machine_of(front, 0.5);
  Governor governor(front, 50.0);
  draw(governor, machine, 40);
  ASSERT_EQ(governor.point(), 3U);
  governor.set_budget(30.0);
  EXPECT_EQ(draw(governor, machine, 10).back().decision.point, 2U);
  governor.set_budget(50.0);
  draw(governor, machine, 40);
  EXPECT_EQ(governor.point(), 3U);
}

TEST(GovernorStepsTest, a_failed_step_is_tried_again_when_frames_are_much_cheaper) {
  const std::vector<GovernorPoint> front = four_points();
  for (const double cheaper : {0.87, 0.75}) {
    Machine machine = machine_with_heavy_points(front, 2, 1.275);
    machine.load = [&](std::size_t frame, std::size_t) { return frame < 1000 ? 1.0 : cheaper; };
    Governor governor(front, 50.0);
    draw(governor, machine, 2000);
    EXPECT_EQ(governor.point(), cheaper == 0.75 ? 2U : 1U)
        << "frames of point 2 would take " << 51.0 * cheaper << " ms, which is less than 45, but not much less";
  }
}

TEST(GovernorStepsTest, a_step_that_has_held_is_no_longer_one_that_has_failed) {
  const std::vector<GovernorPoint> front = four_points();
  Machine machine = machine_with_heavy_points(front, 2, 1.275);
  const double loads[] = {1.0, 0.7, 1.2, 0.84};
  machine.load = [&](std::size_t frame, std::size_t) { return loads[frame / 500]; };
  Governor governor(front, 50.0);
  const Drive drive = draw(governor, machine, 2000);
  EXPECT_EQ(drive[499].point, 1U);
  EXPECT_EQ(drive[999].point, 2U);
  EXPECT_EQ(drive[1499].point, 1U);
  EXPECT_EQ(drive[1999].point, 2U);
}

TEST(GovernorStepsTest, cheap_points_that_grow_less_do_not_make_a_failed_step_look_cheap) {
  const std::vector<GovernorPoint> front = four_points();
  Machine machine = machine_with_heavy_points(front, 3, 1.3);
  machine.ms[0] = 5.0;
  // After the failure the load grows until even point 0 does not fit, and falls again.
  machine.load = [](std::size_t frame, std::size_t) { return frame < 300 || frame >= 500 ? 1.0 : 20.0; };
  Governor governor(front, 95.0);
  const Drive drive = draw(governor, machine, 2000);
  EXPECT_EQ(drive[499].point, 0U);
  EXPECT_EQ(governor.point(), 2U);
  EXPECT_EQ(count(drive, GovernorReason::step_failed), 1U);
}

TEST(GovernorStepsTest, a_clock_that_jumps_does_not_shorten_the_time_until_a_failed_step_is_tried_again) {
  Governor governor(four_points(), 50.0);
  add(governor, 60.0, 4);
  EXPECT_EQ(add(governor, 20.0, 60).reason, GovernorReason::fits_again);
  ASSERT_EQ(add(governor, 60.0, 4).reason, GovernorReason::step_failed);
  // In another view. The jump counts as one second, and 40 frames are 0.8 s.
  add(governor, 1e9, 1, 1);
  EXPECT_EQ(add(governor, 20.0, 40, 1).reason, GovernorReason::none);
  EXPECT_EQ(add(governor, 20.0, 20, 1).reason, GovernorReason::fits_again);
}

}  // namespace
}  // namespace gloam
