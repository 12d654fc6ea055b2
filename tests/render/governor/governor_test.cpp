// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/governor/governor.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>
#include <string_view>
#include <vector>

#include "tests/render/governor/machine.h"
#include "tests/render/governor/small_front.h"
#include "tests/support/expect_assert.h"

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

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

TEST(GovernorTest, starts_with_the_best_point_that_fits_by_the_fronts_own_times) {
  EXPECT_EQ(Governor(four_points(), 44.0).point(), 1U) << "40 ms do not leave 10 % of 44 ms";
  EXPECT_EQ(Governor(four_points(), 45.0).point(), 2U);
  EXPECT_EQ(Governor(four_points(), 1.0).point(), 0U);
  EXPECT_EQ(Governor(four_points(), 1000.0).point(), 3U);
  EXPECT_EQ(Governor(four_points(), kInfinity).point(), 3U);
}

TEST(GovernorTest, moves_to_a_cheaper_point_at_once_and_as_far_as_is_needed) {
  Governor governor(four_points(), 100.0);
  ASSERT_EQ(governor.point(), 3U);
  EXPECT_EQ(add(governor, 80.0, 100).reason, GovernorReason::none);
  EXPECT_EQ(add(governor, 320.0, 3).reason, GovernorReason::none);
  const GovernorDecision decision = governor.add({.ms = 320.0});
  EXPECT_EQ(decision.reason, GovernorReason::over_budget);
  EXPECT_TRUE(decision.changed());
  EXPECT_EQ(decision.previous, 3U);
  EXPECT_EQ(decision.point, 1U) << "frames take four times as long as the front says: 20 ms are 80 ms";
  EXPECT_DOUBLE_EQ(decision.measured_ms, 320.0);
  EXPECT_DOUBLE_EQ(decision.predicted_ms, 80.0);
  EXPECT_DOUBLE_EQ(decision.budget_ms, 100.0);
  EXPECT_EQ(governor.point(), 1U);
}

TEST(GovernorTest, moves_to_a_better_point_after_thirty_frames_that_fit) {
  Governor governor(four_points(), 40.0);
  ASSERT_EQ(governor.point(), 1U);
  EXPECT_EQ(add(governor, 8.0, 29).reason, GovernorReason::none);
  const GovernorDecision decision = governor.add({.ms = 8.0});
  EXPECT_EQ(decision.reason, GovernorReason::fits_again);
  EXPECT_EQ(decision.point, 3U) << "frames take 0.4 of the front's time: 80 ms are 32 ms";
  EXPECT_DOUBLE_EQ(decision.measured_ms, 8.0);
  EXPECT_DOUBLE_EQ(decision.predicted_ms, 32.0);
}

TEST(GovernorTest, the_newest_frames_must_fit_too) {
  Governor governor(four_points(), 40.0);
  add(governor, 8.0, 27);
  EXPECT_EQ(add(governor, 39.0, 3).reason, GovernorReason::none) << "the load has just grown";
}

TEST(GovernorTest, a_small_step_needs_sixty_frames) {
  Governor governor(geometric_front(12, 10.0, 1.08), 20.0);
  ASSERT_EQ(governor.point(), 7U);
  EXPECT_EQ(add(governor, 16.0, 59).reason, GovernorReason::none) << "point 8 gains little";
  EXPECT_EQ(add(governor, 16.0, 1).point, 8U);
  EXPECT_EQ(add(governor, 10.0, 30).point, 11U) << "a large step does not";
}

TEST(GovernorTest, a_better_point_must_leave_ten_percent) {
  Governor governor(four_points(), 40.0);
  EXPECT_EQ(add(governor, 18.1, 1000).reason, GovernorReason::none) << "predicted: 36.2 ms";
  EXPECT_EQ(add(governor, 17.9, 30).point, 2U);
}

TEST(GovernorTest, stays_while_frames_are_between_the_budget_and_ten_percent_below) {
  Governor governor(four_points(), 40.0);
  for (const double ms : {36.5, 38.0, 39.9, 40.0}) EXPECT_EQ(add(governor, ms, 200).reason, GovernorReason::none);
}

TEST(GovernorTest, frames_that_are_not_judged_change_nothing) {
  Governor governor(four_points(), 40.0);
  for (int i = 0; i < 1000; ++i) {
    EXPECT_FALSE(governor.add({.ms = 4000.0, .judged = false}).changed());
    EXPECT_FALSE(governor.add({.ms = 1.0, .judged = false}).changed());
  }
  EXPECT_EQ(governor.point(), 1U);
}

TEST(GovernorTest, one_spike_never_changes_the_point) {
  // Wherever it comes: among the first frames of a point, or after many.
  for (int before = 0; before < 130; ++before) {
    Governor governor(four_points(), 50.0);
    ASSERT_EQ(governor.point(), 2U);
    EXPECT_EQ(add(governor, 44.0, before).reason, GovernorReason::none);
    EXPECT_FALSE(governor.add({.ms = 440.0}).changed());
    EXPECT_EQ(add(governor, 44.0, 130).reason, GovernorReason::none) << before;
  }
}

TEST(GovernorTest, a_spike_now_and_then_does_not_delay_a_step_to_a_better_point) {
  Governor governor(four_points(), 40.0);
  for (int i = 0; i < 29; ++i) governor.add({i % 12 == 0 ? 200.0 : 8.0});
  EXPECT_EQ(governor.add({.ms = 8.0}).point, 3U);
}

TEST(GovernorTest, a_budget_below_the_cheapest_point_is_said_once) {
  Governor governor(four_points(), 30.0);
  const Drive drive = draw(governor, machine_of(four_points(), 20.0), 5000);
  EXPECT_EQ(governor.point(), 0U);
  EXPECT_EQ(count(drive, GovernorReason::cannot_fit), 1U);
  EXPECT_EQ(count(drive, GovernorReason::fits_again), 0U);
  for (const test::DrawnFrame& frame : drive)
    if (frame.decision.reason == GovernorReason::cannot_fit) {
      EXPECT_FALSE(frame.decision.changed());
      EXPECT_DOUBLE_EQ(frame.decision.predicted_ms, 200.0);
    }
}

TEST(GovernorTest, a_budget_that_cannot_be_kept_is_said_again_after_frames_have_fitted) {
  const std::vector<GovernorPoint> front = {{10.0, 0.1}};
  Governor governor(front, 50.0);
  EXPECT_EQ(add(governor, 60.0, 500).reason, GovernorReason::cannot_fit);
  EXPECT_EQ(add(governor, 60.0, 500).reason, GovernorReason::none);
  EXPECT_EQ(add(governor, 48.0, 500).reason, GovernorReason::none) << "fits, but without 10 % to spare";
  EXPECT_EQ(add(governor, 60.0, 500).reason, GovernorReason::none);
  EXPECT_EQ(add(governor, 30.0, 500).reason, GovernorReason::none);
  EXPECT_EQ(add(governor, 60.0, 500).reason, GovernorReason::cannot_fit);
}

TEST(GovernorTest, a_budget_that_cannot_be_kept_is_said_again_when_the_budget_has_changed) {
  Governor governor(four_points(), 5.0);
  EXPECT_EQ(add(governor, 60.0, 500).reason, GovernorReason::cannot_fit);
  governor.set_budget(4.0);
  EXPECT_EQ(governor.add({.ms = 60.0}).reason, GovernorReason::cannot_fit);
  EXPECT_EQ(add(governor, 60.0, 500).reason, GovernorReason::none);
}

TEST(GovernorTest, a_budget_above_the_most_exact_points_time_gives_the_most_exact_point) {
  const std::vector<GovernorPoint> front = geometric_front(12, 5.0, 1.3);
  for (const double budget : {1000.0, kInfinity}) {
    Governor governor(front, 6.0);
    draw(governor, machine_of(front, 2.0), 100);
    governor.set_budget(budget);
    draw(governor, machine_of(front, 2.0), 100);
    EXPECT_EQ(governor.point(), 11U);
    EXPECT_EQ(figures_of(draw(governor, machine_of(front, 2.0), 1000), front).changes, 0U);
  }
}

TEST(GovernorTest, a_changed_budget_acts_in_the_next_frame) {
  Governor governor(four_points(), 100.0);
  add(governor, 80.0, 40);
  governor.set_budget(30.0);
  EXPECT_EQ(governor.point(), 3U) << "not before a frame is added";
  GovernorDecision decision = governor.add({.ms = 80.0});
  EXPECT_EQ(decision.reason, GovernorReason::budget_changed);
  EXPECT_EQ(decision.point, 1U);
  EXPECT_DOUBLE_EQ(decision.predicted_ms, 20.0);
  EXPECT_DOUBLE_EQ(decision.budget_ms, 30.0);
  add(governor, 20.0, 40);
  governor.set_budget(60.0);
  decision = governor.add({.ms = kNan, .judged = false});
  EXPECT_EQ(decision.reason, GovernorReason::budget_changed) << "what was measured before is enough";
  EXPECT_EQ(decision.point, 2U);
}

TEST(GovernorTest, a_budget_that_changes_before_the_first_judged_frame_chooses_the_start_again) {
  Governor governor(four_points(), 100.0);
  governor.add({.ms = 500.0, .judged = false});
  governor.set_budget(25.0);
  const GovernorDecision decision = governor.add({.ms = 500.0, .judged = false});
  EXPECT_EQ(decision.reason, GovernorReason::budget_changed);
  EXPECT_EQ(decision.point, 1U);
}

TEST(GovernorTest, the_same_budget_again_is_no_change) {
  Governor governor(four_points(), 50.0);
  add(governor, 44.0, 40);
  Governor same = governor;
  same.set_budget(50.0);
  EXPECT_EQ(same, governor);
}

TEST(GovernorTest, budgets_must_be_above_zero) {
  Governor governor(four_points(), 50.0);
  EXPECT_ASSERT(governor.set_budget(0.0), "above 0 ms");
  EXPECT_ASSERT(governor.set_budget(-1.0), "above 0 ms");
  EXPECT_ASSERT(governor.set_budget(kNan), "above 0 ms");
  EXPECT_ASSERT((void)Governor(four_points(), 0.0), "above 0 ms");
}

TEST(GovernorTest, of_points_with_equal_times_the_most_exact_is_chosen) {
  const std::vector<GovernorPoint> front = {{10.0, 0.3}, {20.0, 0.2}, {20.0, 0.1}, {20.0, 0.05}, {40.0, 0.01}};
  Governor governor(front, 30.0);
  EXPECT_EQ(governor.point(), 3U);
  add(governor, 31.0, 4);
  EXPECT_EQ(governor.point(), 0U) << "points with the same time would not fit either";
  add(governor, 10.0, 59);
  EXPECT_EQ(governor.point(), 0U) << "point 3 has just taken 31 ms";
  add(governor, 10.0, 1);
  EXPECT_EQ(governor.point(), 3U);
}

TEST(GovernorTest, a_point_that_is_not_more_exact_than_a_cheaper_one_is_never_chosen) {
  const std::vector<GovernorPoint> front = {{10.0, 0.3}, {20.0, 0.1},  {30.0, 0.1},
                                            {40.0, 0.2}, {50.0, kNan}, {60.0, 0.1}};
  std::set<std::size_t> seen;
  for (double budget = 5.0; budget < 200.0; budget *= 1.1) seen.insert(Governor(front, budget).point());
  EXPECT_EQ(seen, (std::set<std::size_t>{0, 1, 4})) << "an unknown error is believed to be less";
}

TEST(GovernorTest, an_empty_front_and_a_front_of_one_point_never_change) {
  Governor empty({}, 30.0);
  Governor one(std::vector<GovernorPoint>{{10.0, 0.1}}, 30.0);
  for (const double ms : {1.0, 1000.0, 5.0, kNan}) {
    for (int i = 0; i < 100; ++i) {
      EXPECT_EQ(empty.add({ms}), (GovernorDecision{.budget_ms = 30.0}));
      EXPECT_EQ(one.add({ms}).point, 0U);
    }
  }
}

TEST(GovernorTest, frames_with_impossible_times_are_ignored) {
  Governor governor(four_points(), 50.0);
  add(governor, 44.0, 50);
  const std::size_t before = governor.point();
  for (int i = 0; i < 200; ++i)
    for (const double ms : {kNan, kInfinity, -kInfinity, 0.0, -5.0, -0.0})
      ASSERT_EQ(governor.add({ms}).reason, GovernorReason::none);
  EXPECT_EQ(governor.point(), before);
  EXPECT_EQ(add(governor, 100.0, 4).reason, GovernorReason::over_budget) << "and it goes on";
}

TEST(GovernorTest, a_front_with_unusable_times_is_used_as_far_as_it_goes) {
  const std::vector<GovernorPoint> front = {{kNan, 0.5}, {0.0, 0.4},       {20.0, 0.3},
                                            {10.0, 0.2}, {kInfinity, 0.1}, {40.0, 0.05}};
  EXPECT_EQ(Governor(front, 30.0).point(), 4U) << "points 0 to 4 count as 20 ms";
  EXPECT_EQ(Governor(front, 10.0).point(), 0U);
  EXPECT_EQ(Governor(front, 50.0).point(), 5U);
  const std::vector<GovernorPoint> nothing = {{kNan, 0.5}, {-1.0, 0.4}, {0.0, 0.3}};
  Governor governor(nothing, 30.0);
  add(governor, 100.0, 100);
  EXPECT_EQ(governor.point(), 0U);
  add(governor, 10.0, 100);
  EXPECT_EQ(governor.point(), 2U);
}

TEST(GovernorTest, a_copy_goes_on_by_itself_and_decides_the_same) {
  const std::vector<GovernorPoint> front = geometric_front(12, 5.0, 1.2);
  Machine machine = machine_of(front);
  machine.noise = 0.1;
  Governor governor(front, 20.0);
  draw(governor, machine, 500);
  Governor copy = governor;
  EXPECT_EQ(copy, governor);
  machine.load = [](std::size_t frame, std::size_t) { return frame % 300 < 150 ? 2.0 : 0.7; };
  const Drive first = draw(governor, machine, 1000);
  EXPECT_NE(copy, governor);
  const Drive second = draw(copy, machine, 1000);
  EXPECT_EQ(copy, governor);
  for (std::size_t i = 0; i < first.size(); ++i) ASSERT_EQ(first[i].decision, second[i].decision) << i;
}

TEST(GovernorTest, every_reason_has_its_name) {
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(GovernorReason::cannot_fit); ++i)
    names.insert(governor_reason_name(static_cast<GovernorReason>(i)));
  EXPECT_EQ(names, (std::set<std::string_view>{"none", "over_budget", "step_failed", "fits_again", "budget_changed",
                                               "cannot_fit"}));
}

}  // namespace
}  // namespace gloam
