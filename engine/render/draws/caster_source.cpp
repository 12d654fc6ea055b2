// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/draws/caster_source.h"

namespace gloam {

gpu::GraphicsPipelineDesc caster_pipeline_desc(const CasterProgram& program, std::string_view module) {
  gpu::GraphicsPipelineDesc desc;
  desc.module = module;
  desc.vertex = program.vertex;
  desc.fragment = program.fragment;
  desc.constants = program.constants;
  desc.attributes = program.attributes;
  desc.stream_strides = program.stream_strides;
  desc.depth_format = kCasterDepthFormat;
  desc.cull = program.cull;
  desc.depth_compare = gpu::CompareOp::greater_equal;
  desc.depth_bias = true;
  return desc;
}

mat4 CasterProjection::clip_from(const dmat4& world_from_local) const {
  dmat4 relative = world_from_local;
  relative[3] -= dvec4(origin, 0.0);
  return mat4(clip_from_relative * relative);
}

void CasterSourceDraw::bind_pipeline(gpu::PipelineHandle pipeline) const {
  gpu::CommandList& commands = context_.commands();
  commands.bind_pipeline(pipeline);
  commands.set_depth_bias(bias_units_, bias_slope_);
}

}  // namespace gloam
