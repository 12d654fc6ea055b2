// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/panel_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "modules/module_list/module_list.h"
#include "tests/sandbox/window/small_knobs.h"
#include "tests/support/knob_text.h"

namespace gloam {
namespace {

using ::testing::HasSubstr;

TEST(PanelModel, a_knobs_type_decides_its_widget) {
  const KnobRegistry knobs = test::small_knobs();
  EXPECT_EQ(widget_of(knobs.knobs()[0]), KnobWidget::combo);
  EXPECT_EQ(widget_of(knobs.knobs()[1]), KnobWidget::integer_slider);
  EXPECT_EQ(widget_of(knobs.knobs()[2]), KnobWidget::number_slider);
}

TEST(PanelModel, a_slider_shows_the_unit_as_it_is_written) {
  const KnobRegistry knobs = test::small_knobs();
  char text[32];
  std::snprintf(text, sizeof(text), slider_format(knobs.knobs()[2]).c_str(), 12.5);
  EXPECT_STREQ(text, "12.5 %");
  std::snprintf(text, sizeof(text), slider_format(knobs.knobs()[1]).c_str(), 16LL);
  EXPECT_STREQ(text, "16");
}

TEST(PanelModel, views_of_modules_that_the_scene_does_not_call_for_are_apart_with_the_reason) {
  std::vector<VisualizerInfo> views = {
      {"none", "engine", "", ""},     {"overdraw", "particles", "", ""},     {"lights_approx", "lights", "", ""},
      {"grass_lod", "grass", "", ""}, {"light_list", "lights", "LIGHT", ""}, {"grass_wind", "grass", "", ""},
      {"own", "of a host", "", ""},   {"grass_reference", "grass", "", ""}};
  views.back().trace = [](World&, const ReferenceInput&) { return Status(); };
  const std::vector<ModuleState> modules = {{.name = "engine", .demanded = true},
                                            {.name = "lights", .demanded = true, .reason = "2 lights"},
                                            {.name = "grass", .demanded = false, .reason = "no surface grows grass"},
                                            {.name = "particles", .demanded = false, .reason = "no emitter"}};
  const ViewGroups groups = view_groups(views, modules);
  std::vector<std::string> names;
  for (const VisualizerInfo* view : groups.called_for) names.push_back(view->name);
  EXPECT_THAT(names, ::testing::ElementsAre("none", "lights_approx", "light_list", "own"));
  ASSERT_EQ(groups.others.size(), 2u);
  EXPECT_EQ(groups.others[0].reason, "no emitter");
  EXPECT_EQ(groups.others[1].module, "grass");
  EXPECT_THAT(groups.others[1].views, ::testing::ElementsAre(&views[3], &views[5]));
  EXPECT_THAT(groups.traced, ::testing::ElementsAre(&views.back())) << "a window does not trace";
}

TEST(PanelModel, a_wide_range_of_factors_moves_in_factors) {
  const KnobRegistry knobs = test::small_knobs();
  EXPECT_TRUE(spans_magnitudes(knobs.knobs()[1]));
  EXPECT_FALSE(spans_magnitudes(knobs.knobs()[2])) << "from 0 there are no factors";
}

TEST(PanelModel, a_tooltip_tells_meaning_range_default_and_the_exact_value) {
  const KnobRegistry knobs = test::small_knobs();
  EXPECT_EQ(knob_tooltip(knobs.knobs()[0]),
            "lamp.filter: how shadows are filtered\nnone, box, tent\ndefault: box\nmost exact: tent");
  EXPECT_EQ(knob_tooltip(knobs.knobs()[2]), "lamp.share: of the light that is kept\n0 to 50 %\ndefault: 12.5 %");
}

TEST(PanelModel, setting_a_value_changes_the_registry_and_keeps_to_the_range) {
  KnobRegistry knobs = test::small_knobs();
  set_knob_value(knobs, knobs.knobs()[0], 2.0);
  EXPECT_EQ(test::knob_text(knobs, "lamp.filter"), "tent");
  set_knob_value(knobs, knobs.knobs()[1], 31.6);
  EXPECT_EQ(test::knob_number(knobs, "lamp.samples"), 32.0);
  set_knob_value(knobs, knobs.knobs()[1], 1e9);
  EXPECT_EQ(test::knob_number(knobs, "lamp.samples"), 256.0);
  set_knob_value(knobs, knobs.knobs()[2], -3.0);
  EXPECT_EQ(test::knob_number(knobs, "lamp.share"), 0.0);
}

TEST(PanelModel, a_reset_gives_the_default_back) {
  KnobRegistry knobs = test::small_knobs();
  for (const Knob& knob : knobs.knobs()) {
    EXPECT_TRUE(is_default(knobs, knob)) << knob.name;
    set_knob_value(knobs, knob, knob.max);
    EXPECT_FALSE(is_default(knobs, knob)) << knob.name;
    reset_knob(knobs, knob);
    EXPECT_TRUE(is_default(knobs, knob)) << knob.name;
  }
}

TEST(PanelModel, every_knob_of_every_module_takes_the_ends_of_its_range) {
  KnobRegistry knobs;
  for (const auto& module : make_all_modules()) module->knobs(knobs);
  ASSERT_FALSE(knobs.knobs().empty());
  for (const Knob& knob : knobs.knobs()) {
    for (const double end : {knob.min, knob.max}) {
      set_knob_value(knobs, knob, end);
      EXPECT_EQ(knob_value(knobs, knob), end) << knob.name;
    }
    EXPECT_THAT(knob_tooltip(knob), HasSubstr(knob.meaning));
  }
}

FrameReport report_of(double gpu_ms, std::vector<PassTime> passes) {
  FrameReport report;
  report.cpu_ms = 2.0 * gpu_ms;
  report.gpu_ms = gpu_ms;
  report.passes = std::move(passes);
  return report;
}

TEST(FrameTimes, are_medians_and_leave_out_frames_the_gpu_has_not_ended) {
  FrameTimes times;
  EXPECT_EQ(times.gpu_ms(), 0.0);
  times.add(10.0, report_of(0.0, {}));
  times.add(30.0, report_of(3.0, {}));
  times.add(20.0, report_of(5.0, {}));
  EXPECT_EQ(times.frame_ms(), 20.0);
  EXPECT_EQ(times.cpu_ms(), 6.0);
  EXPECT_EQ(times.gpu_ms(), 4.0);
}

TEST(FrameTimes, keep_passes_of_one_name_apart) {
  FrameTimes times;
  for (const double ms : {1.0, 9.0, 2.0})
    times.add(1.0, report_of(1.0, {{"blur", "fog", ms}, {"blur", "fog", 10.0 * ms}}));
  ASSERT_EQ(times.passes().size(), 2u);
  EXPECT_EQ(times.passes()[0].ms, 2.0);
  EXPECT_EQ(times.passes()[1].ms, 20.0);
}

TEST(FrameTimes, forget_a_pass_that_stayed_away) {
  FrameTimes times;
  times.add(1.0, report_of(1.0, {{"blur", "fog", 100.0}}));
  times.add(1.0, report_of(1.0, {}));
  EXPECT_TRUE(times.passes().empty());
  times.add(1.0, report_of(1.0, {{"blur", "fog", 1.0}}));
  EXPECT_EQ(times.passes()[0].ms, 1.0);
}

TEST(FrameTimes, forget_what_is_more_than_their_number_of_frames_ago) {
  FrameTimes times;
  for (std::size_t i = 0; i < FrameTimes::kFrames; ++i) times.add(50.0, report_of(1.0, {}));
  for (std::size_t i = 0; i < FrameTimes::kFrames; ++i) times.add(10.0, report_of(1.0, {}));
  EXPECT_EQ(times.frame_ms(), 10.0);
}

TEST(KnobSearch, finds_names_and_meanings_in_any_case) {
  Knob knob;
  knob.name = "fog.radius";
  knob.meaning = "how far light reaches";
  EXPECT_TRUE(matches(knob, ""));
  EXPECT_TRUE(matches(knob, "RADI"));
  EXPECT_TRUE(matches(knob, "light"));
  EXPECT_FALSE(matches(knob, "shadow"));
}

TEST(KnobTexts, hold_what_is_not_at_its_default) {
  KnobRegistry knobs = test::small_knobs();
  EXPECT_EQ(assignments_text(knobs), "");
  EXPECT_EQ(config_text(knobs), "{}\n");
  for (const Knob& knob : knobs.knobs()) set_knob_value(knobs, knob, knob.min == knob.max ? 1.0 : knob.max);
  const std::string config = config_text(knobs), assignments = assignments_text(knobs);
  KnobRegistry read = test::small_knobs();
  ASSERT_TRUE(read.set_from_json(config, "test").ok());
  for (const Knob& knob : knobs.knobs()) {
    EXPECT_EQ(test::knob_text(read, knob.name), test::knob_text(knobs, knob.name));
    EXPECT_EQ(assignments.find(" --set " + knob.name + "=" + test::knob_text(knobs, knob.name)) != std::string::npos,
              !is_default(knobs, knob));
  }
}

TEST(KnobSlotsTest, show_what_was_kept) {
  KnobRegistry knobs = test::small_knobs();
  KnobSlots slots;
  EXPECT_FALSE(slots.has(0));
  slots.keep(knobs, 0);
  const Knob& knob = knobs.knobs().back();
  const std::string before = test::knob_text(knobs, knob.name);
  set_knob_value(knobs, knob, knob.max);
  slots.keep(knobs, 1);
  slots.show(knobs, 0);
  EXPECT_EQ(test::knob_text(knobs, knob.name), before);
  slots.show(knobs, 1);
  EXPECT_EQ(knob_value(knobs, knob), knob.max);
}

TEST(FrameTimesOfSystems, add_the_calls_of_a_frame_and_put_the_longest_first) {
  FrameTimes times;
  const std::vector<Zone> zones = {
      {"sort", "lights", 0, 1000000}, {"bake", "fog", 0, 3000000}, {"sort", "lights", 0, 1000000}};
  times.add_systems(zones);
  ASSERT_EQ(times.systems().size(), 2u);
  EXPECT_EQ(times.systems()[0].name, "bake");
  EXPECT_NEAR(times.systems()[1].ms, 2.0, 1e-9);
}

}  // namespace
}  // namespace gloam
