// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "engine/core/log.h"
#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/vulkan_device.h"
#include "sandbox/options.h"
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

/// Shows a progress bar in a window while a scene is loaded. It has a device of its own: the scene's device may draw
/// frames on another thread meanwhile, and a driver that compiles shaders when they are first executed would delay a
/// picture in the same queue for seconds.
class LoadingScreen {
 public:
  /// The arguments must outlive it. Its swapchain holds the window: destroy it before another one is made.
  [[nodiscard]] static Result<std::unique_ptr<LoadingScreen>> open(Window& window, const Options& options,
                                                                   LogSink& log);

  /// Draws one frame and shows it; nothing while the window is minimised.
  [[nodiscard]] Status show(const LoadingStep& step);

  /// Of its device, with --validate.
  [[nodiscard]] std::uint64_t validation_messages() const { return device_->validation_messages(); }

 private:
  LoadingScreen(std::unique_ptr<gpu::Device> device, std::unique_ptr<gpu::Swapchain> swapchain, Window& window);
  void lay_out(const LoadingStep& step);
  [[nodiscard]] Status declare(bool& shown);

  std::unique_ptr<gpu::Device> device_;
  std::unique_ptr<gpu::Swapchain> swapchain_;
  WindowPictures pictures_;
  Gui gui_;
  FrameGraph graph_;
  std::unique_ptr<PanelRenderer> renderer_;
  float turn_ = 0.0f;  ///< of a bar without a known total
};

}  // namespace gloam
