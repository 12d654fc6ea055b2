// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"
#include "sandbox/play/display/upscaler.h"
#include "sandbox/play/display/window_pictures.h"

namespace gloam {

/// Shows the upscaler's picture in the window again, without drawing the scene.
class KeptPicture {
 public:
  explicit KeptPicture(gpu::Device& device) : device_(device), graph_(device) {}

  /// Draws a frame; present the window's picture after it. overlay: draws over the window's picture.
  [[nodiscard]] Status draw(WindowPictures& pictures, Upscaler& upscaler,
                            const std::function<Status(FrameGraph&, ImageRef&)>& overlay);

 private:
  [[nodiscard]] Status declare(WindowPictures& pictures, Upscaler& upscaler,
                               const std::function<Status(FrameGraph&, ImageRef&)>& overlay);

  gpu::Device& device_;
  FrameGraph graph_;
};

}  // namespace gloam
