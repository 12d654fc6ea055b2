// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/render/pipelines.h"

namespace gloam {

/// A way to draw surfaces: which fragment shader, into what. Each pass that draws meshes has one.
struct SurfacePass {
  std::string name;  ///< "geometry"
  std::string module;
  gpu::ShaderCode fragment;
  std::vector<gpu::Format> color_formats;
  gpu::BlendMode blend = gpu::BlendMode::opaque;
  bool depth_write = true;
  std::vector<gpu::SpecConstant> constants =
      {};  ///< of the fragment shader, but for 0; `name` tells passes of other constants apart
};

/// What distinguishes draws inside a pass. `features`: GLOAM_SURFACE_… bits.
struct SurfaceVariant {
  std::uint32_t features = 0;
  gpu::CullMode cull = gpu::CullMode::back;
  auto operator<=>(const SurfaceVariant&) const = default;
};

[[nodiscard]] gpu::GraphicsPipelineDesc surface_pipeline_desc(const SurfacePass& pass, SurfaceVariant variant);
[[nodiscard]] Result<gpu::PipelineHandle> surface_pipeline(Pipelines& pipelines, const SurfacePass& pass,
                                                           SurfaceVariant variant);

}  // namespace gloam
