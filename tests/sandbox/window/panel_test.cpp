// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <imgui/imgui.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tests/sandbox/window/small_knobs.h"
#include "tests/support/knob_text.h"

namespace gloam {
namespace {

/// Reads a panel's widgets and clicks on them. Nothing is drawn.
class PanelTest : public ::testing::Test {
 protected:
  void frame(const PanelInput& input = {}) {
    const PanelContent content = {.knobs = knobs_,
                                  .times = times_,
                                  .modules = modules_,
                                  .visualizers = visualizers_,
                                  .visualizer = visualizer_,
                                  .show = [this](const std::string& name) -> Status {
                                    if (name == "light_list:moon") return Error{ErrorKind::usage, "no light moon"};
                                    visualizer_ = name;
                                    return {};
                                  },
                                  .scene = scene_,
                                  .budgets = budgets_,
                                  .wipe = wipe_,
                                  .set_wipe = set_wipe_};
    panel_.update(input, {.width = 800, .height = 600, .dt_s = 0.02}, content);
  }

  [[nodiscard]] const PanelWidget* find(const std::string& name) const {
    for (const PanelWidget& widget : panel_.widgets())
      if (widget.name == name) return &widget;
    return nullptr;
  }

  /// Clicks on a widget at a share of its width (0.5: the middle): moves there, presses, releases, and updates once
  /// more.
  void click(const std::string& name, double share = 0.5) {
    for (int i = 0; i < 2; ++i) frame();  // ImGui lays out tables from the cell sizes of the last frame
    const PanelWidget* widget = find(name);
    ASSERT_NE(widget, nullptr) << name << " is not shown";
    PanelInput input = pointing_at(*widget, share);
    frame(input);
    input.buttons[0] = true;
    frame(input);
    frame(input);
    input.buttons[0] = false;
    frame(input);
    last_ = input;
    frame(input);
  }

  /// Presses in the middle of a widget, moves to the right, and releases.
  void drag(const std::string& name, double pixels) {
    for (int i = 0; i < 2; ++i) frame();
    const PanelWidget* widget = find(name);
    ASSERT_NE(widget, nullptr) << name << " is not shown";
    PanelInput input = pointing_at(*widget);
    frame(input);
    input.buttons[0] = true;
    frame(input);
    input.mouse_x += pixels;
    for (int i = 0; i < 2; ++i) frame(input);
    input.buttons[0] = false;
    frame(input);
  }

  [[nodiscard]] static PanelInput pointing_at(const PanelWidget& widget, double share = 0.5) {
    PanelInput input;
    input.mouse_x = widget.left + share * (widget.right - widget.left);
    input.mouse_y = 0.5 * (widget.top + widget.bottom);
    return input;
  }

  void type(const std::u32string& text) {
    PanelInput input = last_;
    input.text = text;
    frame(input);
    input.text.clear();
    input.keys.set(static_cast<std::size_t>(EditKey::enter));
    frame(input);
    for (int i = 0; i < 2; ++i) frame(last_);
  }

  KnobRegistry knobs_ = test::small_knobs();
  FrameTimes times_;
  std::vector<ModuleState> modules_ = {{.name = "lamp", .demanded = true, .reason = "2 lamps"}};
  std::vector<VisualizerInfo> visualizers_ = {{"none", "engine", "", "the lit picture"},
                                              {"heat", "lamp", "", "lamps a tile"},
                                              {"light_list", "lamp", "LIGHT", "pixels of a list"}};
  std::string visualizer_ = "none";
  void SetUp() override { click("knobs lamp"); }

  const PanelScene* scene_ = nullptr;
  const PanelBudgets* budgets_ = nullptr;
  const PanelWipe* wipe_ = nullptr;
  std::function<void(const PanelWipe&)> set_wipe_;
  Panel panel_;
  PanelInput last_;
};

TEST_F(PanelTest, shows_a_widget_and_a_reset_for_every_knob) {
  for (int i = 0; i < 2; ++i) frame();
  for (const Knob& knob : knobs_.knobs()) {
    for (const std::string& name : {knob.name, knob.name + " reset"}) {
      const PanelWidget* widget = find(name);
      ASSERT_NE(widget, nullptr) << name;
      EXPECT_GT(widget->right - widget->left, 20.0f) << name;
      EXPECT_GE(widget->left, 0.0f) << name;
      EXPECT_LE(widget->right, 800.0f) << name;
    }
  }
}

TEST_F(PanelTest, leaves_triangles_and_a_font) {
  frame();
  EXPECT_GT(panel_.draw_data().TotalIdxCount, 0);
  const FontTexels font = panel_.font();
  EXPECT_EQ(font.bytes.size(), std::size_t{font.width} * font.height);
  EXPECT_GT(font.bytes.size(), 0u);
}

TEST_F(PanelTest, nothing_changes_without_the_user) {
  const std::uint64_t version = knobs_.version();
  for (int i = 0; i < 5; ++i) frame();
  EXPECT_EQ(knobs_.version(), version);
  EXPECT_FALSE(panel_.wants_mouse());
  EXPECT_FALSE(panel_.wants_keyboard());
}

TEST_F(PanelTest, a_combo_chooses) {
  click("lamp.filter");
  click("lamp.filter tent");
  EXPECT_EQ(test::knob_text(knobs_, "lamp.filter"), "tent");
  EXPECT_EQ(find("lamp.filter tent"), nullptr) << "the list is closed again";
}

TEST_F(PanelTest, sliders_reach_both_ends_of_their_range) {
  for (const char* name : {"lamp.samples", "lamp.share"}) {
    const Knob& knob = *knobs_.find(name);
    click(name, 0.99);
    EXPECT_EQ(test::knob_number(knobs_, name), knob.max);
    click(name, 0.01);
    EXPECT_EQ(test::knob_number(knobs_, name), knob.min);
  }
}

TEST_F(PanelTest, reset_gives_the_default_back) {
  ASSERT_TRUE(knobs_.set("lamp.samples", "200").ok());
  click("lamp.samples reset");
  EXPECT_EQ(test::knob_number(knobs_, "lamp.samples"), 16.0);
}

TEST_F(PanelTest, a_visualizer_is_chosen) {
  click("view");
  click("view heat");
  EXPECT_EQ(visualizer_, "heat");
}

TEST_F(PanelTest, visualizers_of_idle_modules_are_chosen_from_a_fold) {
  modules_[0] = {.name = "lamp", .demanded = false, .reason = "no lamp"};
  click("view");
  EXPECT_EQ(find("view heat"), nullptr);
  EXPECT_NE(find("view none"), nullptr);
  click("other views", 0.05);
  click("view heat");
  EXPECT_EQ(visualizer_, "heat");
}

TEST_F(PanelTest, a_visualizer_with_an_argument_waits_for_a_good_one) {
  click("view");
  click("view light_list");
  EXPECT_EQ(visualizer_, "none");
  click("view argument");
  EXPECT_TRUE(panel_.wants_keyboard());
  type(U"moon");
  EXPECT_EQ(visualizer_, "none");
  click("view argument");
  PanelInput all = last_;
  all.control = true;
  all.keys.set(static_cast<std::size_t>(EditKey::a));
  frame(all);
  frame(last_);
  type(U"lamp 2");
  EXPECT_EQ(visualizer_, "light_list:lamp 2");
  EXPECT_FALSE(panel_.wants_keyboard());
}

TEST_F(PanelTest, takes_the_mouse_where_it_lies_and_nowhere_else) {
  frame();
  PanelInput over = pointing_at(*find("view"));
  frame(over);
  EXPECT_TRUE(panel_.wants_mouse());
  PanelInput beside;
  beside.mouse_x = 790.0;
  beside.mouse_y = 300.0;
  frame(beside);
  EXPECT_FALSE(panel_.wants_mouse());
  // A drag that begins beside the panel stays with the camera.
  beside.buttons[0] = true;
  frame(beside);
  over.buttons[0] = true;
  frame(over);
  EXPECT_FALSE(panel_.wants_mouse());
}

TEST_F(PanelTest, a_picture_smaller_than_the_panel_is_no_fault) {
  const PanelContent content = {.knobs = knobs_,
                                .times = times_,
                                .modules = modules_,
                                .visualizers = visualizers_,
                                .visualizer = visualizer_,
                                .show = [](const std::string&) { return Status(); }};
  for (const std::uint32_t size : {1u, 20u, 100u})
    panel_.update({}, {.width = size, .height = size, .dt_s = 0.0}, content);
  EXPECT_GE(panel_.draw_data().TotalIdxCount, 0);
}

TEST_F(PanelTest, keeps_two_settings_and_shows_them_in_turn) {
  const Knob& knob = knobs_.knobs().front();
  const std::string before = test::knob_text(knobs_, knob.name);
  click("keep A");
  set_knob_value(knobs_, knob, knob_value(knobs_, knob) == 0.0 ? 1.0 : 0.0);
  const std::string after = test::knob_text(knobs_, knob.name);
  ASSERT_NE(before, after);
  click("keep B");
  click("show A");
  EXPECT_EQ(test::knob_text(knobs_, knob.name), before);
  click("show B");
  EXPECT_EQ(test::knob_text(knobs_, knob.name), after);
}

TEST_F(PanelTest, shows_a_line_for_each_warning_about_the_scene) {
  const std::vector<std::string> warnings = {"no surface shows 1 probe: hall", "light \"lamp\" lies inside a mesh"};
  PanelScene scene = {.warnings = warnings};
  scene_ = &scene;
  frame();
  frame();
  const auto lines = std::ranges::count(panel_.widgets(), "warning", &PanelWidget::name);
  EXPECT_EQ(lines, 2);
  scene.warnings = {};
  frame();
  EXPECT_EQ(find("warning"), nullptr);
}

TEST_F(PanelTest, lights_and_scene_pass_on_what_the_user_changes) {
  const std::vector<PanelLight> lights = {{.name = "lamp", .kind = "spot", .unit = "cd", .intensity = 5.0f}};
  const std::vector<std::string> cameras = {"near", "far"}, picked = {"a pixel"};
  std::string done;
  PanelScene scene = {.cameras = cameras,
                      .show_camera = [&](std::uint32_t number) { done = "camera " + std::to_string(number); },
                      .pause = [&](bool paused) { done = paused ? "paused" : "running"; },
                      .set_exposure = [&](bool automatic, float) { done = automatic ? "automatic" : "by hand"; },
                      .lights = lights,
                      .set_light =
                          [&](std::size_t light, const PanelLight& values) {
                            done = values.muted ? "mute " : values.solo ? "solo " : values.shadows ? "" : "shadows ";
                            done = values.intensity == 5.0f ? done + std::to_string(light) : "intensity";
                          },
                      .locate = [&](std::size_t light) { done = "locate " + std::to_string(light); },
                      .select = [&](std::size_t light) { done = "select " + std::to_string(light); },
                      .measure_shares = [&] { done = "shares"; },
                      .save_lights = [&] { done = "saved lights"; },
                      .picked = picked,
                      .save_config = [&] { done = "saved"; },
                      .copy_command = [&] { done = "copied"; }};
  scene_ = &scene;
  const auto expect = [&](const char* widget, const std::string& what, double share = 0.5) {
    done.clear();
    click(widget, share);
    EXPECT_EQ(done, what) << widget;
  };
  expect("pause", "paused", 0.1);
  expect("exposure auto", "by hand", 0.05);
  expect("save config", "saved");
  expect("copy command", "copied");
  click("camera");
  expect("camera far", "camera 2");
  click("lights");
  expect("lamp mute", "mute 0");
  expect("lamp solo", "solo 0");
  done.clear();
  drag("lamp intensity", 20.0);
  EXPECT_EQ(done, "intensity");
  expect("lights by share", "shares", 0.05);
  expect("save lights", "saved lights");
  expect("lamp", "select 0");
  expect("light locate", "locate 0");
  expect("light shadows", "shadows 0", 0.1);
  expect("lamp", "select " + std::to_string(kNoLight));
  EXPECT_EQ(find("light locate"), nullptr) << "details of the selected light";
}

TEST_F(PanelTest, what_is_selected_or_clicked_comes_into_view) {
  std::vector<PanelLight> lights(30, {.kind = "spot", .unit = "cd", .intensity = 5.0f});
  for (std::size_t i = 0; i < lights.size(); ++i) lights[i].name = "lamp " + std::to_string(i);
  const std::vector<std::string> warnings(9, "a warning"), picked(8, "a line");
  PanelScene scene = {.warnings = warnings, .lights = lights, .select = [](std::size_t) {}, .picked = picked};
  scene_ = &scene;
  const auto in_view = [&](const char* name) {
    for (int i = 0; i < 3; ++i) frame();
    const PanelWidget* widget = find(name);
    return widget != nullptr && widget->top >= 0.0 && widget->bottom <= 600.0;
  };
  click("lights");
  EXPECT_FALSE(in_view("light width"));
  click("lamp 1");
  EXPECT_TRUE(in_view("light width"));
  EXPECT_FALSE(in_view("pixel"));
  scene.pick = 1;
  EXPECT_TRUE(in_view("pixel"));
}

TEST(PickedLines, put_the_light_first_and_fold_lists) {
  const std::vector<std::string> lines = {"pixel 1,2 of tile 0,0", "view depth 5 m",
                                          "illuminance before shadows 11 lx: lamp", "slot 3123",
                                          "final list: 3 lights"};
  const PickedLines sorted = sorted_pick_lines(lines);
  EXPECT_EQ(sorted.shares, (std::vector<std::string>{lines[2]}));
  EXPECT_EQ(sorted.surface, (std::vector<std::string>{lines[0], lines[1]}));
  EXPECT_EQ(sorted.lists, (std::vector<std::string>{lines[3], lines[4]}));
  const std::vector<std::string> fault = {"no frame was drawn"};
  EXPECT_EQ(sorted_pick_lines(fault).surface, fault);
}

TEST(ShownLights, are_found_by_name_and_kind_and_sorted_by_share) {
  const std::vector<PanelLight> lights = {{.name = "Lamp", .kind = "spot", .share = 0.2},
                                          {.name = "moon", .kind = "directional", .share = 0.5},
                                          {.name = "lantern", .kind = "point", .share = 0.3}};
  EXPECT_EQ(shown_lights(lights, "", false), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(shown_lights(lights, "LA", false), (std::vector<std::size_t>{0, 2}));
  EXPECT_EQ(shown_lights(lights, "direct", false), (std::vector<std::size_t>{1}));
  EXPECT_EQ(shown_lights(lights, "", true), (std::vector<std::size_t>{1, 2, 0}));
  EXPECT_TRUE(shown_lights(lights, "sun", true).empty());
}

TEST_F(PanelTest, a_wipe_offers_what_there_is_to_compare) {
  PanelWipe wipe;
  std::vector<PanelWipe> wanted;
  wipe_ = &wipe;
  set_wipe_ = [&](const PanelWipe& w) { wanted.push_back(w); };
  click("wipe", 0.05);
  EXPECT_TRUE(wanted.empty()) << "nothing was kept, and no view is shown";
  ASSERT_TRUE(knobs_.set("lamp.samples", "8").ok());
  click("keep B");
  click("wipe", 0.05);
  ASSERT_EQ(wanted.size(), 1u);
  EXPECT_TRUE(wanted[0].on);
  EXPECT_EQ(wanted[0].side, WipeSide::kept_b);
  ASSERT_EQ(wanted[0].kept.size(), knobs_.knobs().size());
  wipe = wanted[0];
  EXPECT_EQ(find("wipe line"), nullptr);
  click("wipe line", 0.98);
  EXPECT_GT(wanted.back().at, 0.9f);
  wipe = wanted.back();
  wanted.clear();
  for (int i = 0; i < 3; ++i) frame();
  EXPECT_TRUE(wanted.empty()) << "nothing has changed";
  ASSERT_TRUE(knobs_.set("lamp.samples", "32").ok());
  click("keep B");
  ASSERT_FALSE(wanted.empty()) << "settings that are kept anew are shown";
  wipe = wanted.back();
  visualizer_ = "heat";
  click("wipe side");
  EXPECT_EQ(find("wipe side exact"), nullptr) << "there is no budget";
  EXPECT_EQ(find("wipe side A"), nullptr);
  click("wipe side picture");
  EXPECT_EQ(wanted.back().side, WipeSide::picture);
  EXPECT_TRUE(wanted.back().on);
  EXPECT_TRUE(wanted.back().kept.empty());
  wipe = wanted.back();
  EXPECT_EQ(find("wipe side view"), nullptr) << "no other view was shown";
  visualizer_ = "light_list:lamp";
  click("wipe side");
  click("wipe side view");
  EXPECT_EQ(wanted.back().side, WipeSide::view);
  EXPECT_EQ(wanted.back().visualizer, "heat");
  wipe = wanted.back();
  visualizer_ = "none";
  frame();
  EXPECT_TRUE(wanted.back().on) << "the picture beside a view";
  visualizer_ = "heat";
  frame();
  EXPECT_FALSE(wanted.back().on) << "both sides would be the same";
}

TEST_F(PanelTest, budgets_pass_on_what_the_user_changes) {
  const std::vector<PanelBudget> shown = {
      {.ms = 33.0, .setting = "setting 1 of 2", .knobs = {{"lamp.filter", "box", false}, {"lamp.share", "50", true}}},
      {.effect = "lamp", .ms = 5.0, .setting = "setting 1 of 2", .knobs = {{"lamp.samples", "8", false}}}};
  std::string done;
  PanelBudgets budgets = {
      .budgets = shown,
      .set_ms = [&](std::size_t budget,
                    double ms) { done = "budget " + std::to_string(budget) + (ms > 500.0 ? " long" : " short"); },
      .lock = [&](std::size_t budget, const std::string& knob,
                  bool locked) { done = std::to_string(budget) + (locked ? " locks " : " frees ") + knob; }};
  budgets_ = &budgets;
  const auto expect = [&](const char* widget, const char* what, double share = 0.5) {
    done.clear();
    click(widget, share);
    EXPECT_EQ(done, what) << widget;
  };
  expect("budget", "budget 0 long", 0.98);
  expect("budget lamp", "budget 1 short", 0.1);
  expect("lock lamp.filter", "0 locks lamp.filter");
  expect("lock lamp.share", "0 frees lamp.share");
  expect("lock lamp.samples", "1 locks lamp.samples");
  EXPECT_EQ(budgets.find("lamp.share")->locked, true);
  EXPECT_EQ(budgets.find("lamp.other"), nullptr);
}

}  // namespace
}  // namespace gloam
