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

/// What one frame of the panel shows, and what it may change.
struct PanelContent {
  KnobRegistry& knobs;
  const FrameTimes& times;
  std::span<const ModuleState> modules;
  std::span<const VisualizerInfo> visualizers;
  std::string visualizer;  ///< the current one: name, or name:argument
  /// Changes it; an error is shown.
  std::function<Status(const std::string& visualizer)> show;
};

/// The picture the panel lies over.
struct PanelFrame {
  std::uint32_t width = 0;  ///< pixels, > 0
  std::uint32_t height = 0;
  double dt_s = 0.0;  ///< since the last frame
};

/// One coverage byte a pixel, row by row from the top.
struct FontTexels {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::span<const std::byte> bytes;
};

/// A widget of the last frame, in pixels from the picture's upper left.
struct PanelWidget {
  std::string name;  ///< of the knob; "view" for the choice of a visualizer
  float left = 0.0f;
  float top = 0.0f;
  float right = 0.0f;
  float bottom = 0.0f;
};

/// The panel of knobs, times, passes and modules, by Dear ImGui; draws nothing itself. One panel is in use at a time on
/// a thread.
class Panel {
 public:
  /// scale: size of letters and widgets, 1 on a usual display.
  explicit Panel(double scale = 1.0);
  ~Panel();
  Panel(const Panel&) = delete;
  Panel& operator=(const Panel&) = delete;

  /// Takes one frame's input, changes what the user changes, and leaves draw data.
  void update(const PanelInput& input, const PanelFrame& frame, const PanelContent& content);

  /// Whether the last update's mouse or keyboard is the panel's alone.
  [[nodiscard]] bool wants_mouse() const;
  [[nodiscard]] bool wants_keyboard() const;

  /// Of the last update, valid until the next; there must have been one.
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
  std::string asked_;     ///< visualizer that waits for its argument
  std::string argument_;  ///< as typed
  std::string fault_;     ///< of the last visualizer asked for
};

}  // namespace gloam
