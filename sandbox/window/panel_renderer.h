// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "engine/core/result.h"
#include "engine/frame/frame_graph.h"
#include "engine/frame/transfers/upload.h"
#include "engine/gpu/device.h"
#include "engine/render/pipelines/pipelines.h"
#include "sandbox/window/panel.h"

struct ImDrawData;

namespace gloam {

/// Draws a panel over a picture, in one pass.
class PanelRenderer {
 public:
  /// Uploads the font, so it must not be called between Device::begin_frame and submit_frame.
  [[nodiscard]] static Result<std::unique_ptr<PanelRenderer>> create(gpu::Device& device, const FontTexels& font);
  ~PanelRenderer();
  PanelRenderer(const PanelRenderer&) = delete;
  PanelRenderer& operator=(const PanelRenderer&) = delete;

  /// Declares the pass. Call it once per frame, after Device::begin_frame. data is copied. picture: a UNORM format, to
  /// which ImGui's sRGB-encoded colours are written unchanged, or an sRGB format; on return it is the version that the
  /// pass writes. If there is nothing to draw, no pass is added.
  [[nodiscard]] Status add_pass(FrameGraph& graph, ImageRef& picture, const ImDrawData& data);

 private:
  struct DrawCall {
    std::uint32_t indices = 0;
    std::uint32_t first_index = 0;
    std::int32_t vertex_offset = 0;
    std::int32_t x = 0;  ///< x, y, width and height: scissor rectangle, pixels
    std::int32_t y = 0;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
  };

  explicit PanelRenderer(gpu::Device& device);
  [[nodiscard]] Status prepare(const FontTexels& font);
  [[nodiscard]] Result<gpu::PipelineHandle> pipeline_for(gpu::Format format);
  [[nodiscard]] static std::vector<DrawCall> draw_calls(const ImDrawData& data, std::uint32_t width,
                                                        std::uint32_t height);
  [[nodiscard]] Result<UploadSlice> upload_vertices(const ImDrawData& data);
  [[nodiscard]] Result<UploadSlice> upload_indices(const ImDrawData& data);

  gpu::Device& device_;
  Pipelines pipelines_;
  UploadRing ring_;
  gpu::ImageHandle font_;
  gpu::SamplerHandle sampler_;
};

}  // namespace gloam
