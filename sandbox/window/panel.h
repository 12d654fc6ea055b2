// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/renderer.h"
#include "sandbox/window/gui.h"
#include "sandbox/window/panel_budget.h"
#include "sandbox/window/panel_mark.h"
#include "sandbox/window/panel_model.h"
#include "sandbox/window/panel_scene.h"
#include "sandbox/window/panel_wipe.h"

namespace gloam {

/// A message at the top of the panel; none if the text is empty.
struct PanelNotice {
  std::string text;
  bool is_error = false;
};

/// Pipelines that are compiled while frames are drawn; nothing is shown if none is left.
struct PanelProgress {
  std::string name;      ///< of the one that is being compiled
  std::size_t left = 0;  ///< with that one
};

/// The data that one frame of the panel shows and may change.
struct PanelContent {
  KnobRegistry& knobs;
  const FrameTimes& times;
  std::span<const ModuleState> modules;
  std::span<const VisualizerInfo> visualizers;
  std::string visualizer;  ///< the current visualizer: NAME or NAME:ARGUMENT
  /// Changes the visualizer. The panel shows the error if it fails.
  std::function<Status(const std::string& visualizer)> show;
  double scale = 1.0;           ///< of the frame's width and height to the window's
  std::string scale_note = {};  ///< why the scale is as it is; empty: no note
  double scale_setting = 1.0;   ///< 0: automatic
  std::span<const double> scale_steps = {};
  std::function<void(double setting)> set_scale = {};   ///< empty: the scale is shown only
  const PanelScene* scene = nullptr;                    ///< null: not shown
  const PanelBudgets* budgets = nullptr;                ///< null: not shown
  const PanelWipe* wipe = nullptr;                      ///< null: not offered
  std::function<void(const PanelWipe&)> set_wipe = {};  ///< set with `wipe`
  PanelNotice notice = {};
  PanelProgress progress = {};
  float heat_range = 1.0f;  ///< ViewSettings::heat_range
  std::vector<PanelMark> marks = {};
};

/// Rectangle of a widget in the last frame, in pixels from the picture's upper left corner.
struct PanelWidget {
  /// "knobs MODULE", KNOB, "KNOB reset", "KNOB CHOICE", "search", "view", "view VISUALIZER", "other views", "view
  /// argument", "scale", "scale auto", "scale NN %", "camera", "camera NAME", "warning", "pause", "exposure auto",
  /// "exposure", "lens", "lens here", "lens focus", "lens f-number", "pixel", "pixel lists", "lights", "lights by
  /// share", "lights search", "save lights", LIGHT, "LIGHT color", "LIGHT mute", "LIGHT solo", "LIGHT intensity",
  /// "light locate", "light shadows", "light cookie", "light range", "light width", "keep A", "show A", "keep B", "show
  /// B", "save config", "copy command", "budget section", "budget", "budget EFFECT", "lock KNOB", "wipe", "wipe side",
  /// "wipe side SIDE" or "wipe line"
  std::string name;
  float left = 0.0f;
  float top = 0.0f;
  float right = 0.0f;
  float bottom = 0.0f;
};

/// The panel of knobs, times, passes and modules, laid out by Dear ImGui. It draws nothing: PanelRenderer does. Every
/// call sets ImGui's current context, which is global, so all panels must be used on one thread.
class Panel {
 public:
  /// scale: factor on the size of text and widgets; 1 for a standard display.
  explicit Panel(double scale = 1.0) : gui_(scale) {}

  /// Handles one frame's input, applies the user's changes to knobs and visualizer, and makes the draw data.
  void update(const PanelInput& input, const PanelFrame& frame, const PanelContent& content);

  /// See Gui; of the last update.
  [[nodiscard]] bool wants_mouse() const { return gui_.wants_mouse(); }
  [[nodiscard]] bool wants_keyboard() const { return gui_.wants_keyboard(); }
  [[nodiscard]] bool is_busy() const { return gui_.is_busy(); }
  [[nodiscard]] const ImDrawData& draw_data() const { return gui_.draw_data(); }
  [[nodiscard]] FontTexels font() const { return gui_.font(); }
  [[nodiscard]] std::span<const PanelWidget> widgets() const { return widgets_; }

 private:
  void show_times(const FrameTimes& times);
  void show_scale(const PanelContent& content, const PanelFrame& frame);
  void show_scale_choice(const PanelContent& content);
  void show_views(const PanelContent& content);
  void show_view_list(const PanelContent& content, const std::string& current);
  void show_traced_views(std::span<const VisualizerInfo* const> views);
  void show_view_choice(const PanelContent& content, const VisualizerInfo& info, const std::string& current);
  void show_heat_scale(const PanelContent& content, const HeatScale& heat);
  void show_view_argument(const PanelContent& content, const VisualizerInfo& info);
  void show_settings(const PanelContent& content);
  void show_scene(const PanelScene& scene);
  void show_lens(const PanelScene& scene);
  void show_pixel(const PanelScene& scene);
  void show_lights(const PanelScene& scene);
  void show_light_table(const PanelScene& scene);
  void show_light(const PanelScene& scene, std::size_t index);
  void show_light_details(const PanelScene& scene);
  void show_budgets(const PanelBudgets& budgets);
  void show_budget(const PanelBudgets& budgets, std::size_t index);
  void show_budget_knobs(const PanelBudgets& budgets, std::size_t index);
  [[nodiscard]] bool offers(const PanelContent& content, WipeSide side) const;
  /// The wipe with another right side.
  [[nodiscard]] PanelWipe wipe_of(const PanelWipe& now, WipeSide side) const;
  void show_wipe(const PanelContent& content);
  void show_knobs(const PanelContent& content);
  [[nodiscard]] bool begin_knob_group(const KnobGroup& group);
  void show_knob_group(const PanelContent& content, const KnobGroup& group);
  void show_knob(const PanelContent& content, const Knob& knob);
  void show_knob_value(KnobRegistry& knobs, const Knob& knob);
  void remember_widget(const std::string& name);
  /// Scrolls so that the place reached so far is in view: at 0 as the panel's first line, at 1 as its last.
  static void bring_into_view(float share);

  Gui gui_;
  std::vector<PanelWidget> widgets_;
  std::string asked_;     ///< chosen visualizer that waits for its argument
  std::string argument_;  ///< text typed as the argument
  std::string search_;    ///< text that the shown knobs contain
  std::string light_search_;
  bool lights_by_share_ = false;
  std::size_t selected_light_ = kNoLight;
  bool bring_details_ = false;   ///< a light was selected: its details are to come into view
  std::uint64_t seen_pick_ = 0;  ///< PanelScene::pick whose lines have been brought into view
  KnobSlots slots_;
  std::string view_now_ = "none";
  std::string view_before_;               ///< shown before view_now_; empty: none yet
  WipeSide wipe_side_ = WipeSide::exact;  ///< chosen last
  std::string fault_;                     ///< error of the last chosen visualizer; empty: none
};

}  // namespace gloam
