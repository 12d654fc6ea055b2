// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/governor/budget_control.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/render/governor/budget_knobs.h"

namespace gloam {
namespace {

using test::budget_knobs;
using test::three_points;
using ::testing::HasSubstr;

/// Draws a frame with the knobs as they are.
GovernorDecision draw(BudgetControl& control, KnobRegistry& knobs, double ms, int frames = 1) {
  GovernorDecision last;
  for (int frame = 0; frame < frames; ++frame) {
    const GovernorDecision decision = control.add({.ms = ms}, knobs.version(), knobs);
    if (decision.changed()) last = decision;
  }
  return last;
}

TEST(BudgetControl, sets_the_knobs_that_points_name_and_no_others) {
  KnobRegistry knobs = budget_knobs();
  ASSERT_TRUE(knobs.set("fog.radius", "3").ok());
  auto control = BudgetControl::create({.ms = 25.0, .front = three_points()}, knobs);
  ASSERT_TRUE(control.ok()) << control.error().message;
  control->apply(knobs);
  EXPECT_EQ(control->state().point, 1u) << "20 ms fit";
  EXPECT_EQ(test::knob_text(knobs, "shadows.filter"), "pcf");
  EXPECT_EQ(test::knob_text(knobs, "views.scale"), "1") << "the faster point's value is not this one's";
  EXPECT_EQ(test::knob_text(knobs, "fog.radius"), "3") << "no point names it";

  EXPECT_TRUE(draw(*control, knobs, 60.0, 20).changed());
  EXPECT_EQ(control->state().point, 0u);
  EXPECT_EQ(control->state().last_change.reason, GovernorReason::over_budget);
  EXPECT_EQ(test::knob_text(knobs, "shadows.filter"), "hard");
  EXPECT_EQ(test::knob_text(knobs, "views.scale"), "0.5");
  EXPECT_EQ(control->state().error, 0.1);
  EXPECT_EQ(control->state().changes, 1u);

  draw(*control, knobs, 5.0, 400);
  EXPECT_EQ(control->state().point, 2u) << "there is room for all";
  EXPECT_EQ(test::knob_text(knobs, "shadows.filter"), "chs") << "the default";
  EXPECT_EQ(test::knob_text(knobs, "views.scale"), "1");
}

TEST(BudgetControl, locked_knobs_keep_their_values) {
  KnobRegistry knobs = budget_knobs();
  ASSERT_TRUE(knobs.set("shadows.filter", "chs").ok());
  auto control = BudgetControl::create({.ms = 11.0, .front = three_points(), .locked = {"shadows.filter"}}, knobs);
  ASSERT_TRUE(control.ok());
  control->apply(knobs);
  EXPECT_EQ(control->state().point, 0u);
  EXPECT_EQ(test::knob_text(knobs, "shadows.filter"), "chs");
  EXPECT_EQ(test::knob_text(knobs, "views.scale"), "0.5");
}

TEST(BudgetControl, frames_of_earlier_values_and_the_first_of_new_ones_are_not_judged) {
  KnobRegistry knobs = budget_knobs();
  auto control = BudgetControl::create({.ms = 25.0, .front = three_points()}, knobs);
  ASSERT_TRUE(control.ok());
  const std::uint64_t before = knobs.version();
  control->apply(knobs);
  ASSERT_NE(knobs.version(), before);
  for (int frame = 0; frame < 100; ++frame)
    EXPECT_FALSE(control->add({.ms = 500.0}, before, knobs).changed()) << "pipelines are still being made";
  for (std::uint32_t frame = 0; frame < BudgetControl::kUnjudged; ++frame)
    EXPECT_FALSE(control->add({.ms = 500.0}, knobs.version(), knobs).changed());
  EXPECT_TRUE(draw(*control, knobs, 500.0, 20).changed());
}

TEST(BudgetControl, neighbours_are_asked_for_once_after_each_change) {
  KnobRegistry knobs = budget_knobs();
  auto control = BudgetControl::create({.ms = 25.0, .front = three_points()}, knobs);
  ASSERT_TRUE(control.ok());
  control->apply(knobs);
  EXPECT_FALSE(control->take_settled()) << "nothing is drawn yet";
  int settled = 0;
  for (int frame = 0; frame < 20; ++frame) {
    draw(*control, knobs, 15.0);
    settled += control->take_settled() ? 1 : 0;
  }
  EXPECT_EQ(settled, 1);
  const std::uint64_t version = knobs.version();
  KnobRegistry values = knobs;
  ASSERT_TRUE(control->set_neighbour(1, values));
  EXPECT_EQ(test::knob_text(values, "shadows.filter"), "chs");
  ASSERT_TRUE(control->set_neighbour(-1, values));
  EXPECT_EQ(test::knob_text(values, "views.scale"), "0.5");
  EXPECT_EQ(knobs.version(), version);
  draw(*control, knobs, 90.0, 8);  // to the fastest point
  EXPECT_EQ(control->state().point, 0u);
  EXPECT_FALSE(control->set_neighbour(-1, values));
  draw(*control, knobs, 90.0, 2);
  EXPECT_TRUE(control->take_settled());
}

TEST(BudgetControl, points_that_others_beat_are_left_out) {
  std::vector<FrontPoint> front = three_points();
  front.push_back({.ms = 45.0, .error = 0.2, .settings = {{"fog.radius", "1"}}});
  front.push_back({.ms = -1.0, .error = 0.0});
  std::swap(front[0], front[2]);
  const auto control = BudgetControl::create({.ms = 25.0, .front = front}, budget_knobs());
  ASSERT_TRUE(control.ok());
  EXPECT_EQ(control->state().points, 3u);
  EXPECT_EQ(control->state().error, 0.02);
}

TEST(BudgetControl, refuses_what_it_cannot_do) {
  const KnobRegistry knobs = budget_knobs();
  const auto message = [&](FrameBudget budget) {
    const auto control = BudgetControl::create(std::move(budget), knobs);
    EXPECT_FALSE(control.ok());
    EXPECT_EQ(control.error().kind, ErrorKind::usage);
    return control.error().message;
  };
  EXPECT_THAT(message({.ms = 0.0, .front = three_points()}), HasSubstr("above 0 ms"));
  EXPECT_THAT(message({.ms = std::numeric_limits<double>::quiet_NaN(), .front = three_points()}), HasSubstr("above 0"));
  EXPECT_THAT(message({.ms = 10.0}), HasSubstr("a measured setting"));
  EXPECT_THAT(message({.ms = 10.0, .front = {{1.0, 0.1, {{"shadows.filtre", "pcf"}}}}}), HasSubstr("shadows.filter"));
  EXPECT_THAT(message({.ms = 10.0, .front = {{1.0, 0.1, {{"shadows.filter", "soft"}}}}}), HasSubstr("pcf"));
  EXPECT_THAT(message({.ms = 10.0, .front = three_points(), .locked = {"x"}}), HasSubstr("unknown knob x is locked"));
}

}  // namespace
}  // namespace gloam
