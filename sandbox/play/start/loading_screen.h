// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "engine/frame/frame_graph.h"
#include "sandbox/play/display/window_pictures.h"
#include "sandbox/window/gui.h"
#include "sandbox/window/panel_renderer.h"

namespace gloam {

/// Progress of loading. total: 0 if it is not known.
struct LoadingStep {
  std::string what;
  std::size_t done = 0;
  std::size_t total = 0;
};

/// Shows a progress bar in a window while a scene is loaded.
class LoadingScreen {
 public:
  /// The arguments must outlive it. scale: factor on the size of text.
  LoadingScreen(gpu::Device& device, WindowPictures& pictures, double scale);

  /// Draws one frame and shows it; nothing while the window is minimised. Must not be called between
  /// Device::begin_frame and submit_frame.
  [[nodiscard]] Status show(const LoadingStep& step);

 private:
  void lay_out(const LoadingStep& step);
  [[nodiscard]] Status declare(FrameGraph& graph, bool& shown);

  gpu::Device& device_;
  WindowPictures& pictures_;
  Gui gui_;
  FrameGraph graph_;
  std::unique_ptr<PanelRenderer> renderer_;
  float turn_ = 0.0f;  ///< of a bar without a known total
};

}  // namespace gloam
