// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/budget/budget_controls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/sandbox/play/budget/empty_session.h"
#include "tests/support/knob_text.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

class BudgetControlsTest : public ::testing::Test {
 protected:
  void SetUp() override { set_budget(25.0); }
  void TearDown() override { EXPECT_THAT(device_->faults(), IsEmpty()); }

  void set_budget(double ms, std::vector<std::string> locked = {}) {
    const Status set = renderer_.set_budget({.ms = ms, .front = test::session_points(), .locked = std::move(locked)});
    ASSERT_TRUE(set.ok()) << set.error().message;
  }
  [[nodiscard]] std::string value(const char* knob) { return test::knob_text(renderer_.knobs(), knob); }
  [[nodiscard]] const PanelBudgetKnob& knob(const std::string& name) {
    controls_.begin();
    for (const PanelBudgetKnob& knob : controls_.budgets().front().knobs)
      if (knob.name == name) return knob;
    ADD_FAILURE() << name << " is not shown";
    return controls_.budgets().front().knobs.front();
  }

  gpu::RecordingDevice* device_ = nullptr;
  std::unique_ptr<Session> session_ = test::empty_session(device_);
  Renderer& renderer_ = *session_->renderer;
  BudgetControls controls_{renderer_};
};

TEST_F(BudgetControlsTest, a_lock_keeps_the_value_and_its_end_gives_it_back) {
  controls_.begin();
  controls_.lock(0, "shadows.filter", true);
  controls_.end();
  EXPECT_TRUE(knob("shadows.filter").locked);
  EXPECT_EQ(value("shadows.filter"), "pcf");
  EXPECT_THAT(renderer_.budget()->governed, ::testing::ElementsAre("views.scale"));
  ASSERT_TRUE(renderer_.knobs().set("shadows.filter", "chs").ok());
  controls_.begin();
  controls_.lock(0, "shadows.filter", false);
  controls_.end();
  EXPECT_FALSE(knob("shadows.filter").locked);
  EXPECT_EQ(value("shadows.filter"), "pcf");
}

TEST_F(BudgetControlsTest, a_governed_knob_that_the_user_changes_is_locked) {
  controls_.begin();
  ASSERT_TRUE(renderer_.knobs().set("shadows.filter", "chs").ok());
  ASSERT_TRUE(renderer_.knobs().set("shadows.mode", "monolithic").ok());
  controls_.end();
  EXPECT_EQ(value("shadows.filter"), "chs");
  EXPECT_EQ(renderer_.budget()->locked, std::vector<std::string>{"shadows.filter"}) << "no point names shadows.mode";
  EXPECT_TRUE(knob("shadows.filter").locked);
  EXPECT_FALSE(knob("views.scale").locked);
  const std::uint64_t version = renderer_.knobs().version();
  controls_.begin();
  controls_.end();
  EXPECT_EQ(renderer_.knobs().version(), version) << "nothing changes without the user";
}

TEST_F(BudgetControlsTest, another_time_keeps_front_and_locks) {
  set_budget(25.0, {"views.scale"});
  controls_.begin();
  controls_.set_ms(0, 12.0);
  controls_.end();
  const BudgetState state = *renderer_.budget();
  EXPECT_EQ(state.ms, 12.0);
  EXPECT_EQ(state.points, 3u);
  EXPECT_EQ(state.locked, std::vector<std::string>{"views.scale"});
  EXPECT_THAT(controls_.fault(), IsEmpty());
  controls_.set_ms(0, -1.0);
  EXPECT_THAT(controls_.fault(), HasSubstr("above 0 ms"));
  EXPECT_EQ(renderer_.budget()->ms, 12.0);
}

TEST_F(BudgetControlsTest, a_knob_of_an_effect_with_a_budget_is_shown_there_only) {
  set_budget(25.0, {"shadows.filter"});
  const Status set = renderer_.set_budget(
      {.effect = "shadows", .ms = 5.0, .front = test::session_points(), .locked = {"views.scale"}});
  ASSERT_TRUE(set.ok()) << set.error().message;
  controls_.begin();
  ASSERT_EQ(controls_.budgets().size(), 2u);
  EXPECT_THAT(controls_.budgets()[0].knobs, IsEmpty());
  EXPECT_EQ(controls_.budgets()[1].knobs.size(), 2u);
}

TEST_F(BudgetControlsTest, exact_settings_are_those_of_the_most_exact_point_for_governed_knobs) {
  set_budget(11.0, {"views.scale"});
  EXPECT_EQ(value("shadows.filter"), "hard");
  const std::vector<KnobOverride> exact = exact_settings(renderer_.budgets());
  ASSERT_EQ(exact.size(), 1u);
  EXPECT_EQ(exact[0].name, "shadows.filter");
  EXPECT_EQ(exact[0].value, value_text(*renderer_.knobs().find("shadows.filter"),
                                       renderer_.knobs().find("shadows.filter")->default_number));
}

TEST(PanelBudgetTest, says_what_steps_cost) {
  const KnobRegistry knobs;
  BudgetState state = {.ms = 33.0, .points = 9, .point = 3, .error = 0.05, .settings = {}, .last_change = {}};
  state.measured_ms = 30.0;
  state.cheaper = BudgetStep{.ms = 25.0, .error = 0.08, .settings = {{"shadows.filter", "hard"}}};
  state.better = BudgetStep{.ms = 42.0, .error = 0.01};
  PanelBudget shown = panel_budget(state, knobs);
  EXPECT_EQ(shown.setting, "setting 4 of 9");
  EXPECT_EQ(shown.error, "error 0.05 (mean FLIP, 0 is equal)");
  EXPECT_EQ(shown.measured, "90 % of frames take at most 30 ms; the budget is 33");
  EXPECT_EQ(shown.down, "saves 5 ms, error +0.03");
  EXPECT_EQ(shown.up, "costs 12 ms, error -0.04");
  EXPECT_EQ(shown.down_knobs, "shadows.filter=hard");
  EXPECT_EQ(shown.up_knobs, "all knobs at their defaults");
  EXPECT_EQ(shown.moved, "the budget has not moved yet");

  state.cheaper = state.better = std::nullopt;
  state.measured_ms = 0.0;
  state.named = state.locked = {"shadows.filter"};
  state.changes = 1;
  state.last_change = {.previous = 4,
                       .point = 3,
                       .reason = GovernorReason::over_budget,
                       .measured_ms = 40.0,
                       .predicted_ms = 30.0,
                       .budget_ms = 33.0};
  shown = panel_budget(state, knobs);
  EXPECT_EQ(shown.down, "none, this is the fastest");
  EXPECT_EQ(shown.up, "none, this is the most exact");
  EXPECT_THAT(shown.measured, HasSubstr("no frame measured yet"));
  EXPECT_THAT(shown.error, HasSubstr("without the locks"));
  EXPECT_THAT(shown.moved, HasSubstr("moved last: over budget: 40 ms, 33 wanted; now setting 4 of 9"));
}

}  // namespace
}  // namespace gloam
