// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/passes/passes.h"
#include "engine/render/scene/material_packing.h"
#include "shaders/render/shaders.h"

namespace gloam {

Status add_geometry_pass(FrameBuilder& frame) {
  GLOAM_TRY(frame.prepare_surfaces(frame.draws().solid, geometry_surface_pass()));
  const SurfacePass& surfaces = geometry_surface_pass();
  GeometryOutputs outputs;
  outputs.base_color = create_view_image(frame, "base_color", "engine", surfaces.color_formats[0]);
  outputs.normals = create_view_image(frame, "normals", "engine", surfaces.color_formats[1]);
  outputs.material = create_view_image(frame, "material", "engine", surfaces.color_formats[2]);
  outputs.emissive = create_view_image(frame, "emissive", "engine", surfaces.color_formats[3]);
  outputs.depth = create_view_image(frame, "depth", "engine", gpu::Format::d32_float);

  PassBuilder pass = frame.graph().add_pass("geometry", "engine");
  outputs.base_color = pass.write(outputs.base_color, gpu::Access::color_target);
  outputs.normals = pass.write(outputs.normals, gpu::Access::color_target);
  outputs.material = pass.write(outputs.material, gpu::Access::color_target);
  outputs.emissive = pass.write(outputs.emissive, gpu::Access::color_target);
  outputs.depth = pass.write(outputs.depth, gpu::Access::depth_target);
  frame.read_vertices(pass);
  frame.put(outputs);
  pass.execute([&frame, outputs](PassContext& context) {
    gpu::RenderingDesc rendering;
    // Depth alone marks sky; colours are cleared only so that every texel is defined.
    for (const ImageRef ref : {outputs.base_color, outputs.normals, outputs.material, outputs.emissive})
      rendering.colors.push_back({.view = {.image = context.image(ref)}});
    rendering.depth.view.image = context.image(outputs.depth);
    rendering.width = frame.view().width;
    rendering.height = frame.view().height;
    gpu::CommandList& commands = context.commands();
    commands.begin_rendering(rendering);
    commands.set_viewport(0.0f, 0.0f, static_cast<float>(rendering.width), static_cast<float>(rendering.height));
    commands.set_scissor(0, 0, rendering.width, rendering.height);
    const gpu::Binding bindings[] = {frame.view_binding()};
    const Status drawn = frame.draw_surfaces(context, frame.draws().solid, geometry_surface_pass(), bindings);
    if (!drawn.ok()) context.fail(drawn.error());
    commands.end_rendering();
  });
  return {};
}

Status add_depth_bounds_pass(FrameBuilder& frame) {
  const FrameServices& services = frame.services();
  auto pipeline = services.pipelines.get(
      gpu::ComputePipelineDesc{"depth_bounds", "engine", shaders::render::depth_bounds_comp, {}});
  if (!pipeline.ok()) return pipeline.error();
  auto sampler = frame.nearest_sampler();
  if (!sampler.ok()) return sampler.error();

  GeometryOutputs& outputs = frame.get<GeometryOutputs>();
  outputs.depth_bounds = create_view_image(frame, "depth_bounds", "engine", gpu::Format::rg32_float, kTileSize);
  PassBuilder pass = frame.graph().add_pass("depth_bounds", "engine");
  pass.read(outputs.depth, gpu::Access::compute_read);
  outputs.depth_bounds = pass.write(outputs.depth_bounds, gpu::Access::compute_write);
  pass.execute([&frame, outputs, pipeline = *pipeline, sampler = *sampler](PassContext& context) {
    gpu::CommandList& commands = context.commands();
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {{0, gpu::Binding::Sampled{{.image = context.image(outputs.depth)}, sampler}},
                                     {1, gpu::Binding::Storage{{.image = context.image(outputs.depth_bounds)}}}};
    commands.bind(bindings);
    const gpu::ImageDesc& tiles = frame.graph().desc(outputs.depth_bounds);
    commands.dispatch((tiles.width + 7) / 8, (tiles.height + 7) / 8, 1);
  });
  return {};
}

}  // namespace gloam
