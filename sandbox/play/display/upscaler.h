// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"
#include "engine/render/pipelines/pipelines.h"

namespace gloam {

/// Owns the image that frames of a reduced resolution are drawn into, and enlarges it to the window's picture.
class Upscaler {
 public:
  explicit Upscaler(gpu::Device& device) : device_(device), pipelines_(device) {}
  ~Upscaler() { release(); }
  Upscaler(const Upscaler&) = delete;
  Upscaler& operator=(const Upscaler&) = delete;

  /// The image for a view of this size, made anew if the size changes: a ViewTarget::image to be left ready for
  /// gpu::Access::fragment_read. Call it between frames. Its values are sRGB-encoded by the shader that draws it.
  [[nodiscard]] Result<gpu::ImageHandle> image(std::uint32_t width, std::uint32_t height);
  /// The image of the last image(); a null handle after release().
  [[nodiscard]] gpu::ImageHandle kept_image() const { return image_; }
  /// Frees the image.
  void release();

  /// Declares the passes that enlarge `picture`, in an UNORM format, to all of `window`, also UNORM, whose content is
  /// discarded. On return `window` is the version that they write.
  [[nodiscard]] Status add_passes(FrameGraph& graph, ImageRef picture, ImageRef& window);

 private:
  [[nodiscard]] Status add_pass(FrameGraph& graph, ImageRef from, ImageRef& to, bool vertical);
  [[nodiscard]] Result<gpu::PipelineHandle> pipeline_for(gpu::Format format, bool vertical);

  gpu::Device& device_;
  Pipelines pipelines_;
  gpu::ImageHandle image_;
};

}  // namespace gloam
