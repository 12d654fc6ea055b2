// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include "modules/lighting/environment.h"
#include "modules/lighting/passes.h"
#include "shaders/lighting/shaders.h"

namespace gloam {

namespace {

gpu::GraphicsPipelineDesc deferred_pipeline(bool tiled, std::uint32_t directional_lights) {
  gpu::GraphicsPipelineDesc desc = fullscreen_pipeline(
      (tiled ? "deferred/tiled/" : "deferred/brute/") + std::to_string(directional_lights), "lighting",
      tiled ? shaders::lighting::deferred_tiled_frag : shaders::lighting::deferred_frag, gpu::Format::rgba16_float);
  desc.constants = {{1, directional_lights}};
  static const int xbits = std::getenv("GX") ? std::atoi(std::getenv("GX")) : 0;
  if (tiled) desc.constants.push_back({2, (xbits & 8) ? 0u : 1u});
  return desc;
}

/// What the pass records with.
struct Deferred {
  ShadingInputs inputs;
  bool tiled = false;
  GeometryOutputs geometry;
  ImageRef texels;
  ImageRef color;
  gpu::PipelineHandle pipeline;
  gpu::SamplerHandle sampler;
};

void declare_reads(PassBuilder& pass, const Deferred& d) {
  const GeometryOutputs& g = d.geometry;
  for (const ImageRef ref : {g.base_color, g.normals, g.material, g.emissive, g.depth})
    pass.read(ref, gpu::Access::fragment_read);
  const LightsOutputs& lights = d.inputs.outputs;
  if (lights.texels) pass.read(lights.texels, gpu::Access::fragment_read);
  if (!d.tiled) return;
  pass.read(lights.tile_lists, gpu::Access::fragment_read);
  pass.read(lights.early_lists, gpu::Access::fragment_read);
  pass.read(lights.group_masks, gpu::Access::fragment_read);
}

void record(FrameBuilder& frame, PassContext& context, const Deferred& d) {
  const auto sampled = [&](ImageRef ref) { return gpu::Binding::Sampled{{.image = context.image(ref)}, d.sampler}; };
  const GeometryOutputs& g = d.geometry;
  FullscreenPass draw;
  draw.pipeline = d.pipeline;
  draw.bindings = {frame.view_binding(),       {1, d.inputs.lights},    {2, d.inputs.environment},
                   {3, sampled(g.base_color)}, {4, sampled(g.normals)}, {5, sampled(g.material)},
                   {6, sampled(g.emissive)},   {7, sampled(g.depth)},   {8, sampled(d.texels)}};
  if (d.tiled) {
    const LightsOutputs& lights = d.inputs.outputs;
    draw.bindings.push_back({9, lights.grid});
    draw.bindings.push_back({10, sampled(lights.tile_lists)});
    draw.bindings.push_back({11, gpu::Binding::BufferRange{context.buffer(lights.early_lists)}});
    draw.bindings.push_back({12, gpu::Binding::BufferRange{context.buffer(lights.group_masks)}});
  }
  draw.target = context.image(d.color);
  draw.width = frame.view().width;
  draw.height = frame.view().height;
  record_fullscreen(context.commands(), draw);
}

}  // namespace

Status add_deferred_pass(FrameBuilder& frame) {
  const FrameServices& services = frame.services();
  auto inputs = shading_inputs(frame);
  if (!inputs.ok()) return inputs.error();
  Deferred d;
  d.inputs = *inputs;
  d.tiled = inputs->outputs.has_lists();
  // Brute force draws the same picture while the tiled pipeline is made.
  if (d.tiled && !services.wait_for_pipelines)
    d.tiled = services.pipelines.request({deferred_pipeline(true, inputs->directional_count)}, services.log);
  auto pipeline = services.pipelines.get(deferred_pipeline(d.tiled, inputs->directional_count));
  if (!pipeline.ok()) return pipeline.error();
  d.pipeline = *pipeline;
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  d.sampler = *sampler;

  d.geometry = frame.get<GeometryOutputs>();
  // Without local lights the shader does not look at the image, but every binding must be given.
  d.texels = inputs->outputs.texels ? inputs->outputs.texels : d.geometry.base_color;
  LitOutput& lit = frame.get<LitOutput>();
  PassBuilder pass = frame.graph().add_pass("deferred", "lighting");
  declare_reads(pass, d);
  d.color = lit.color = pass.write(lit.color, gpu::Access::color_target);
  pass.execute([&frame, d](PassContext& context) { record(frame, context, d); });
  return {};
}

}  // namespace gloam
