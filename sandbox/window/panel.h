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
#include "sandbox/window/panel_input.h"
#include "sandbox/window/panel_model.h"

struct ImDrawData;
struct ImGuiContext;

namespace gloam {

/// The data that one frame of the panel shows and may change.
struct PanelContent {
  KnobRegistry& knobs;
  const FrameTimes& times;
  std::span<const ModuleState> modules;
  std::span<const VisualizerInfo> visualizers;
  std::string visualizer;  ///< the current visualizer: NAME or NAME:ARGUMENT
  /// Changes the visualizer. The panel shows the error if it fails.
  std::function<Status(const std::string& visualizer)> show;
};

/// The picture that the panel is drawn over.
struct PanelFrame {
  std::uint32_t width = 0;  ///< pixels, > 0
  std::uint32_t height = 0;
  double dt_s = 0.0;  ///< since the last frame
};

/// The font's texture: one coverage byte per texel, row by row from the top.
struct FontTexels {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::span<const std::byte> bytes;
};

/// Rectangle of a widget in the last frame, in pixels from the picture's upper left corner.
struct PanelWidget {
  std::string name;  ///< KNOB, "KNOB reset", "KNOB CHOICE", "view", "view VISUALIZER" or "view argument"
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
  explicit Panel(double scale = 1.0);
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  /// Handles one frame's input, applies the user's changes to knobs and visualizer, and makes the draw data.
  void update(const PanelInput& input, const PanelFrame& frame, const PanelContent& content);

  /// Whether the panel used the mouse or keyboard input of the last update, so that nothing else may use it.
  [[nodiscard]] bool wants_mouse() const;
  [[nodiscard]] bool wants_keyboard() const;

  /// Draw data of the last update, valid until the next. There must have been an update.
  [[nodiscard]] const ImDrawData& draw_data() const;
  /// Valid as long as the panel.
  [[nodiscard]] FontTexels font() const;
  [[nodiscard]] std::span<const PanelWidget> widgets() const { return widgets_; }

 private:
  void show_times(const FrameTimes& times);
  void show_views(const PanelContent& content);
  void show_view_argument(const PanelContent& content, const VisualizerInfo& info);
  void show_knobs(KnobRegistry& knobs);
  void show_knob(KnobRegistry& knobs, const Knob& knob);
  void remember_widget(const std::string& name);

  ImGuiContext* context_ = nullptr;
  std::vector<PanelWidget> widgets_;
  std::string asked_;     ///< chosen visualizer that waits for its argument
  std::string argument_;  ///< text typed as the argument
  std::string fault_;     ///< error of the last chosen visualizer; empty: none
};

}  // namespace gloam
