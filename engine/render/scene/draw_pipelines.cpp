// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/scene/draw_pipelines.h"

#include "engine/render/packing/mesh_packing.h"
#include "shaders/render/shaders.h"

namespace gloam {

const gpu::ShaderCode& surface_vertex_shader(const SurfacePass& pass) {
  return pass.motion ? shaders::render::surface_motion_vert : shaders::render::surface_vert;
}

gpu::GraphicsPipelineDesc surface_pipeline_desc(const SurfacePass& pass, SurfaceVariant variant) {
  gpu::GraphicsPipelineDesc desc;
  desc.module = pass.module;
  desc.vertex = surface_vertex_shader(pass);
  desc.fragment = pass.fragment;
  desc.constants = pass.constants;
  desc.constants.set("kSurface", variant.features);
  desc.attributes = {{0, 0, gpu::Format::rgb32_float, 0},
                     {1, 1, gpu::Format::rg32_uint, 0},
                     {2, 2, gpu::Format::rgba32_float, offsetof(PackedSurface, uv0)},
                     {3, 2, gpu::Format::rgba16_float, offsetof(PackedSurface, color)}};
  desc.stream_strides = {sizeof(vec3), sizeof(PackedFrame), sizeof(PackedSurface)};
  if (pass.motion) {
    desc.attributes.push_back({4, 3, gpu::Format::rgb32_float, 0});
    desc.stream_strides.push_back(sizeof(vec3));
  }
  desc.color_formats = pass.color_formats;
  desc.depth_format = gpu::Format::d32_float;
  desc.cull = variant.cull;
  desc.blend = pass.blend;
  desc.depth_compare = gpu::CompareOp::greater_equal;
  desc.depth_write = pass.depth_write;
  return desc;
}

Result<gpu::PipelineHandle> surface_pipeline(Pipelines& pipelines, const SurfacePass& pass, SurfaceVariant variant) {
  return pipelines.get(surface_pipeline_desc(pass, variant));
}

}  // namespace gloam
