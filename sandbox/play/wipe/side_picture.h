// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"
#include "engine/render/pipelines/pipelines.h"
#include "engine/render/view_request.h"
#include "sandbox/play/display/upscaler.h"

namespace gloam {

/// The picture on the right side of a wipe: one that is shown, and one that is drawn meanwhile.
class SidePicture {
 public:
  explicit SidePicture(gpu::Device& device) : device_(device), pipelines_(device), upscaler_(device) {}
  ~SidePicture() { release(); }
  SidePicture(const SidePicture&) = delete;
  SidePicture& operator=(const SidePicture&) = delete;

  /// A view to draw the next picture with. settings: of the window's size. scale: share of width and height that is
  /// drawn and then enlarged, above 0, at most 1. Call it between frames.
  [[nodiscard]] Result<ViewRequest> request(const ViewSettings& settings, double scale);
  /// The drawn picture becomes the shown one.
  void show_drawn();
  /// A picture is shown over windows of this size.
  [[nodiscard]] bool fits(std::uint32_t width, std::uint32_t height) const;
  /// Declares the pass that draws the shown picture over `window` to the right of `at`, a share of its width, and the
  /// line. On return `window` is the version that it writes. Adds none if no picture fits.
  [[nodiscard]] Status add_pass(FrameGraph& graph, ImageRef& window, float at);
  /// Frees the images.
  void release();

 private:
  [[nodiscard]] Result<gpu::ImageHandle> image(std::uint32_t width, std::uint32_t height);
  [[nodiscard]] Result<gpu::PipelineHandle> pipeline_for(gpu::Format format);

  gpu::Device& device_;
  Pipelines pipelines_;
  Upscaler upscaler_;
  std::array<gpu::ImageHandle, 2> images_;  ///< shown, drawn; sRGB-encoded values
};

}  // namespace gloam
