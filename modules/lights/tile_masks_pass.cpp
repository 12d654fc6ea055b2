// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/tile_masks_pass.h"

#include "modules/lights/outputs.h"
#include "shaders/lights/shaders.h"

namespace gloam {

gpu::ComputePipelineDesc tile_masks_pipeline() { return {"tile_masks", "lights", shaders::lights::tile_masks_comp, {}}; }

Status add_tile_masks_pass(FrameBuilder& frame, const VisibleLights& visible) {
  const FrameServices& services = frame.services();
  LightsOutputs outputs;
  outputs.local_count = visible.block.local_count;
  auto lights = services.uniforms.write_value(visible.block);
  if (!lights.ok()) return lights.error();
  outputs.lights = *lights;
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

}  // namespace gloam
