// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/governor/budgets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/render/governor/budget_knobs.h"

namespace gloam {
namespace {

using test::budget_knobs;
using test::knob_text;
using test::three_points;
using ::testing::HasSubstr;

const std::vector<std::string> kEffects = {"fog", "shadows"};

std::vector<FrontPoint> fog_points() {
  return {{.ms = 1.0, .error = 0.1, .settings = {{"fog.radius", "1"}}},
          {.ms = 4.0, .error = 0.0, .settings = {{"fog.radius", "3"}}}};
}

void draw_at(BudgetControl& control, KnobRegistry& knobs, double ms, int frames) {
  for (int frame = 0; frame < frames; ++frame) control.add({.ms = ms}, knobs.version(), knobs);
}

TEST(Budgets, an_effect_keeps_within_its_own_time) {
  KnobRegistry knobs = budget_knobs();
  Budgets budgets;
  ASSERT_TRUE(budgets.set({.ms = 25.0, .front = three_points()}, kEffects, knobs).ok());
  ASSERT_TRUE(budgets.set({.effect = "fog", .ms = 6.0, .front = fog_points()}, kEffects, knobs).ok());
  EXPECT_EQ(knob_text(knobs, "fog.radius"), "3");
  EXPECT_EQ(knob_text(knobs, "shadows.filter"), "pcf");

  draw_at(*budgets.find("fog"), knobs, 9.0, 20);
  EXPECT_EQ(knob_text(knobs, "fog.radius"), "1") << "9 ms are over 6";
  EXPECT_EQ(knob_text(knobs, "shadows.filter"), "pcf") << "the frame's own budget has seen no frame";
  ASSERT_EQ(budgets.states().size(), 2u);
  EXPECT_EQ(budgets.states()[0].effect, "");
  EXPECT_EQ(budgets.states()[1].effect, "fog");
  EXPECT_EQ(budgets.states()[1].point, 0u);

  budgets.clear("fog");
  EXPECT_EQ(budgets.find("fog"), nullptr);
  EXPECT_EQ(knob_text(knobs, "fog.radius"), "1") << "values stay";
  EXPECT_NE(budgets.find(""), nullptr);
}

TEST(Budgets, a_second_budget_of_an_effect_replaces_the_first) {
  KnobRegistry knobs = budget_knobs();
  Budgets budgets;
  ASSERT_TRUE(budgets.set({.effect = "fog", .ms = 6.0, .front = fog_points()}, kEffects, knobs).ok());
  ASSERT_TRUE(budgets.set({.effect = "fog", .ms = 2.0, .front = fog_points()}, kEffects, knobs).ok());
  ASSERT_EQ(budgets.states().size(), 1u);
  EXPECT_EQ(budgets.states()[0].ms, 2.0);
  EXPECT_EQ(knob_text(knobs, "fog.radius"), "1");
}

TEST(Budgets, two_budgets_do_not_set_one_knob) {
  KnobRegistry knobs = budget_knobs();
  Budgets budgets;
  ASSERT_TRUE(budgets.set({.ms = 25.0, .front = three_points()}, kEffects, knobs).ok());
  FrameBudget second = {.effect = "shadows", .ms = 5.0, .front = three_points(), .locked = {"views.scale"}};
  const std::uint64_t version = knobs.version();
  const Status refused = budgets.set(second, kEffects, knobs);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().kind, ErrorKind::usage);
  EXPECT_THAT(refused.error().message, HasSubstr("shadows.filter"));
  EXPECT_EQ(knobs.version(), version);
  EXPECT_EQ(budgets.find("shadows"), nullptr);

  ASSERT_TRUE(budgets.set({.ms = 25.0, .front = three_points(), .locked = {"shadows.filter"}}, kEffects, knobs).ok());
  EXPECT_TRUE(budgets.set(second, kEffects, knobs).ok());
}

TEST(Budgets, unknown_effects_are_refused_with_the_valid_ones) {
  KnobRegistry knobs = budget_knobs();
  Budgets budgets;
  const Status refused = budgets.set({.effect = "shadow", .ms = 5.0, .front = fog_points()}, kEffects, knobs);
  ASSERT_FALSE(refused.ok());
  EXPECT_THAT(refused.error().message, HasSubstr("did you mean shadows?"));
}

TEST(Budgets, a_state_says_what_a_step_costs) {
  KnobRegistry knobs = budget_knobs();
  Budgets budgets;
  ASSERT_TRUE(budgets.set({.ms = 25.0, .front = three_points(), .locked = {"views.scale"}}, kEffects, knobs).ok());
  BudgetControl& control = *budgets.find("");
  EXPECT_EQ(control.state().measured_ms, 0.0);
  ASSERT_TRUE(control.state().better);
  EXPECT_EQ(control.state().better->ms, 40.0) << "the front's own time";
  draw_at(control, knobs, 24.0, 20);
  const BudgetState state = control.state();
  EXPECT_DOUBLE_EQ(state.measured_ms, 24.0);
  ASSERT_TRUE(state.cheaper && state.better);
  EXPECT_DOUBLE_EQ(state.cheaper->ms, 12.0) << "frames take 1.2 times the front's time";
  EXPECT_DOUBLE_EQ(state.better->ms, 48.0);
  EXPECT_EQ(state.cheaper->error, 0.1);
  EXPECT_EQ(state.governed, std::vector<std::string>{"shadows.filter"});
  EXPECT_EQ(state.locked, std::vector<std::string>{"views.scale"});
  draw_at(control, knobs, 60.0, 20);
  EXPECT_FALSE(control.state().cheaper) << "the fastest point";
}

TEST(Budgets, a_changed_time_keeps_the_point_and_what_its_frames_have_shown) {
  KnobRegistry knobs = budget_knobs();
  Budgets budgets;
  ASSERT_TRUE(budgets.set({.ms = 25.0, .front = three_points()}, kEffects, knobs).ok());
  BudgetControl& control = *budgets.find("");
  draw_at(control, knobs, 24.0, 20);
  ASSERT_TRUE(budgets.change("", 30.0, {}, knobs).ok());
  EXPECT_EQ(control.state().ms, 30.0);
  EXPECT_EQ(control.state().point, 1u);
  EXPECT_DOUBLE_EQ(control.state().measured_ms, 24.0);
  ASSERT_TRUE(budgets.change("", 15.0, {}, knobs).ok());
  draw_at(control, knobs, 24.0, 1);
  EXPECT_EQ(control.state().point, 0u);
  EXPECT_EQ(control.state().last_change.reason, GovernorReason::budget_changed);
}

TEST(Budgets, a_lock_keeps_a_value_until_it_is_taken_away) {
  KnobRegistry knobs = budget_knobs();
  Budgets budgets;
  ASSERT_TRUE(budgets.set({.ms = 11.0, .front = three_points()}, kEffects, knobs).ok());
  BudgetControl& control = *budgets.find("");
  ASSERT_EQ(knob_text(knobs, "shadows.filter"), "hard");
  ASSERT_TRUE(knobs.set("shadows.filter", "chs").ok());
  ASSERT_TRUE(budgets.change("", 11.0, {"shadows.filter"}, knobs).ok());
  EXPECT_EQ(knob_text(knobs, "shadows.filter"), "chs");
  EXPECT_EQ(knob_text(knobs, "views.scale"), "0.5");
  EXPECT_THAT(control.state().governed, ::testing::ElementsAre("views.scale"));
  EXPECT_THAT(control.state().named, ::testing::ElementsAre("shadows.filter", "views.scale"));
  ASSERT_EQ(control.state().exact.size(), 1u);
  EXPECT_EQ(control.state().exact[0].name + "=" + control.state().exact[0].value, "views.scale=1");
  draw_at(control, knobs, 1.0, 400);
  EXPECT_EQ(control.state().point, 2u);
  ASSERT_TRUE(knobs.set("shadows.filter", "pcf").ok());
  ASSERT_TRUE(budgets.change("", 11.0, {}, knobs).ok());
  EXPECT_EQ(knob_text(knobs, "shadows.filter"), "chs") << "the value of the point in use";
}

TEST(Budgets, a_change_that_is_refused_changes_nothing) {
  KnobRegistry knobs = budget_knobs();
  Budgets budgets;
  ASSERT_TRUE(budgets.set({.ms = 25.0, .front = three_points(), .locked = {"shadows.filter"}}, kEffects, knobs).ok());
  ASSERT_TRUE(
      budgets.set({.effect = "shadows", .ms = 5.0, .front = three_points(), .locked = {"views.scale"}}, kEffects, knobs)
          .ok());
  const std::uint64_t version = knobs.version();
  const auto message = [&](std::string_view effect, double ms, std::vector<std::string> locked) {
    const Status refused = budgets.change(effect, ms, std::move(locked), knobs);
    EXPECT_FALSE(refused.ok());
    return refused.ok() ? std::string() : refused.error().message;
  };
  EXPECT_THAT(message("fog", 5.0, {}), HasSubstr("the budget of fog is not set"));
  EXPECT_THAT(message("", 0.0, {"shadows.filter"}), HasSubstr("above 0 ms"));
  EXPECT_THAT(message("", 20.0, {"shadow"}), HasSubstr("unknown knob shadow"));
  EXPECT_THAT(message("", 20.0, {}), HasSubstr("the budget of shadows sets shadows.filter"));
  EXPECT_EQ(budgets.find("")->state().ms, 25.0);
  EXPECT_EQ(knobs.version(), version);
}

}  // namespace
}  // namespace gloam
