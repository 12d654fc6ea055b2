// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <cstdlib>
#include "engine/render/material_packing.h"
#include "engine/render/passes.h"
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
    // Sky is told by depth alone: colours are only cleared so that every texel is defined.
    for (const ImageRef ref : {outputs.base_color, outputs.normals, outputs.material, outputs.emissive})
      rendering.colors.push_back({.view = {.image = context.image(ref)}, .load = std::getenv("GDISC") ? gpu::LoadOp::discard : gpu::LoadOp::clear});
    rendering.depth.view.image = context.image(outputs.depth);
    rendering.width = frame.view().width;
    rendering.height = frame.view().height;
    gpu::CommandList& commands = context.commands();
    commands.begin_rendering(rendering);
    commands.set_viewport(0.0f, 0.0f, static_cast<float>(rendering.width), static_cast<float>(rendering.height));
    commands.set_scissor(0, 0, rendering.width, rendering.height);
    const gpu::Binding bindings[] = {frame.view_binding()};
    // Pipelines were made in declaration: nothing is left to fail.
    static const int xbits = std::getenv("GX") ? std::atoi(std::getenv("GX")) : 0;
    static const std::size_t parts = std::getenv("GSPLIT") ? static_cast<std::size_t>(std::atoi(std::getenv("GSPLIT"))) : 1;
    std::span<const Draw> rest = frame.draws().solid;
    std::size_t total = 0;
    for (const Draw& draw : rest) total += draw.index_count;
    for (std::size_t part = 0; part < parts; ++part) {
      std::size_t count = 0, sum = 0;
      while (count < rest.size() && (part + 1 == parts || sum < total / parts)) sum += rest[count++].index_count;
      if (part > 0) {
        commands.end_rendering();
        if (xbits & 4) {
          gpu::RenderingDesc none = rendering;
          none.colors.clear();
          none.depth.load = gpu::LoadOp::load;
          commands.begin_rendering(none);
          commands.end_rendering();
        }
        for (auto& color : rendering.colors) color.load = gpu::LoadOp::load;
        rendering.depth.load = gpu::LoadOp::load;
        commands.begin_rendering(rendering);
        commands.set_viewport(0.0f, 0.0f, static_cast<float>(rendering.width), static_cast<float>(rendering.height));
        commands.set_scissor(0, 0, rendering.width, rendering.height);
      }
      static_cast<void>(frame.draw_surfaces(context, rest.first(count), geometry_surface_pass(), bindings));
      rest = rest.subspan(count);
    }
    commands.end_rendering();
  });
  return {};
}

Status add_depth_bounds_pass(FrameBuilder& frame) {
  const FrameServices& services = frame.services();
  auto pipeline =
      services.pipelines.get(gpu::ComputePipelineDesc{"depth_bounds", "engine", shaders::render::depth_bounds_comp, {}});
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
