// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/render/pipelines/pipelines.h"

namespace gloam {

/// Pipeline state that all draws of a pass share: fragment shader, targets, blending. Each pass that draws meshes has
/// one.
struct SurfacePass {
  std::string module;
  gpu::ShaderCode fragment;
  std::vector<gpu::Format> color_formats;
  gpu::BlendMode blend = gpu::BlendMode::opaque;
  bool depth_write = true;
  /// Constants of the fragment shader, except kSurface (surface_api.glsl).
  gpu::SpecConstants constants = {};
  /// The fragment shader reads the positions in the previous frame (surface_motion.vert).
  bool motion = false;
};
/// The vertex shader of a surface pass.
[[nodiscard]] const gpu::ShaderCode& surface_vertex_shader(const SurfacePass& pass);

/// Pipeline state that differs between the draws of a pass. `features`: GLOAM_SURFACE_… bits.
struct SurfaceVariant {
  std::uint32_t features = 0;
  gpu::CullMode cull = gpu::CullMode::back;
  auto operator<=>(const SurfaceVariant&) const = default;
};

[[nodiscard]] gpu::GraphicsPipelineDesc surface_pipeline_desc(const SurfacePass& pass, SurfaceVariant variant);
[[nodiscard]] Result<gpu::PipelineHandle> surface_pipeline(Pipelines& pipelines, const SurfacePass& pass,
                                                           SurfaceVariant variant);

}  // namespace gloam
