// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/tile_masks_pass.h"

#include "modules/lights/outputs.h"
#include "shaders/lights/shaders.h"

namespace gloam {

gpu::ComputePipelineDesc tile_masks_pipeline() { return {"tile_masks", "lights", shaders::lights::tile_masks_comp, {}}; }

namespace {

/// Local lights into an image, see light_texels.comp.
Status add_light_texels_pass(FrameBuilder& frame, LightsOutputs& outputs) {
  auto pipeline = frame.services().pipelines.get(light_texels_pipeline());
  if (!pipeline.ok()) return pipeline.error();
  gpu::ImageDesc desc;
  desc.name = "light_texels";
  desc.module = "lights";
  desc.format = gpu::Format::rgba32_float;
  desc.width = 3;
  desc.height = GLOAM_MAX_LOCAL_LIGHTS;
  PassBuilder pass = frame.graph().add_pass("light_texels", "lights");
  outputs.texels = pass.write(frame.graph().create_image(desc), gpu::Access::compute_write);
  pass.execute([outputs, pipeline = *pipeline](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {{0, outputs.lights}, {1, gpu::Binding::Storage{{.image = context.image(outputs.texels)}}}};
    commands.bind(bindings);
    commands.dispatch((outputs.local_count + 63) / 64, 1, 1);
  });
  return {};
}

}  // namespace

gpu::ComputePipelineDesc light_texels_pipeline() { return {"light_texels", "lights", shaders::lights::light_texels_comp, {}}; }

Status add_tile_masks_pass(FrameBuilder& frame, const VisibleLights& visible) {
  const FrameServices& services = frame.services();
  LightsOutputs outputs;
  outputs.local_count = visible.block.local_count;
  outputs.directional_count = visible.block.directional_count;
  auto lights = services.uniforms.write_value(visible.block);
  if (!lights.ok()) return lights.error();
  outputs.lights = *lights;
  GLOAM_TRY(add_light_texels_pass(frame, outputs));
  if (frame.knobs().is("lights.culling", "brute")) {
    frame.put(outputs);
    return {};
  }

  auto pipeline = services.pipelines.get(tile_masks_pipeline());
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  const GeometryOutputs geometry = frame.get<GeometryOutputs>();
  const gpu::ImageDesc& tiles = frame.graph().desc(geometry.depth_bounds);
  gpu::ImageDesc desc;
  desc.name = "tile_masks";
  desc.module = "lights";
  desc.format = gpu::Format::r32_uint;
  desc.width = tiles.width;
  desc.height = tiles.height;
  desc.layers = GLOAM_LIGHT_GROUPS + 1;
  desc.shape = gpu::ImageShape::array;
  outputs.tile_masks = frame.graph().create_image(desc);

  PassBuilder pass = frame.graph().add_pass("tile_masks", "lights");
  pass.read(geometry.depth_bounds, gpu::Access::compute_read);
  outputs.tile_masks = pass.write(outputs.tile_masks, gpu::Access::compute_write);
  frame.put(outputs);
  pass.execute([&frame, outputs, bounds = geometry.depth_bounds, pipeline = *pipeline, sampler = *sampler](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {frame.view_binding(),
                                     {1, outputs.lights},
                                     {2, gpu::Binding::Sampled{{.image = context.image(bounds)}, sampler}},
                                     {3, gpu::Binding::Storage{{.image = context.image(outputs.tile_masks), .as_array = true}}}};
    commands.bind(bindings);
    const gpu::ImageDesc& image = frame.graph().desc(outputs.tile_masks);
    commands.dispatch((image.width + 7) / 8, (image.height + 7) / 8, 1);
  });
  return {};
}

Status add_tile_masks_view_pass(FrameBuilder& frame) {
  const FrameServices& services = frame.services();
  const LightsOutputs outputs = frame.get<LightsOutputs>();
  if (!outputs.tile_masks) return Error{ErrorKind::usage, "view tile_masks needs lights.culling=tiled"};
  TargetOutput& target = frame.get<TargetOutput>();
  gpu::GraphicsPipelineDesc desc = fullscreen_pipeline("tile_masks_view/" + std::string(gpu::name_of(target.format)), "lights",
                                                       shaders::lights::tile_masks_view_frag, target.format);
  desc.constants = {{0, gpu::encodes_srgb(target.format) ? 0u : 1u}};
  auto pipeline = services.pipelines.get(desc);
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();
  PassBuilder pass = frame.graph().add_pass("tile_masks_view", "lights");
  pass.read(outputs.tile_masks, gpu::Access::fragment_read);
  target.color = pass.write(target.color, gpu::Access::color_target);
  pass.execute([&frame, masks = outputs.tile_masks, color = target.color, pipeline = *pipeline, sampler = *sampler](PassContext& context) {
    FullscreenPass draw;
    draw.pipeline = pipeline;
    draw.bindings = {{0, gpu::Binding::Sampled{{.image = context.image(masks), .as_array = true}, sampler}}};
    draw.target = context.image(color);
    draw.width = frame.view().width;
    draw.height = frame.view().height;
    record_fullscreen(context.commands(), draw);
  });
  return {};
}

}  // namespace gloam
