// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/gpu/vulkan_device.h"
#include "sandbox/window/window.h"

namespace gloam {

/// The pictures of a window, whose size follows the window.
class WindowPictures {
 public:
  /// The arguments must outlive it.
  WindowPictures(Window& window, gpu::Swapchain& swapchain) : window_(window), swapchain_(swapchain) {}

  /// Makes the pictures anew if the window has another size than they have. Call it before each frame. Returns false if
  /// the window is minimised: then there is nothing to draw.
  [[nodiscard]] Result<bool> follow_window();
  /// Size in pixels, of the last follow_window().
  [[nodiscard]] std::uint32_t width() const { return width_; }
  [[nodiscard]] std::uint32_t height() const { return height_; }

  /// The picture to fill, while a frame is recorded; none if the window has changed meanwhile.
  [[nodiscard]] Result<gpu::ImageHandle> acquire();
  /// Shows the acquired picture, after the frame was submitted. Returns whether there was one.
  [[nodiscard]] Result<bool> present();

  [[nodiscard]] Window& window() { return window_; }

 private:
  Window& window_;
  gpu::Swapchain& swapchain_;
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  bool fits_ = false;
};

}  // namespace gloam
