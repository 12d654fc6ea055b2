// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <optional>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/declare/draw_pass.h"
#include "engine/render/passes/culling_passes.h"
#include "engine/render/passes/renderer_passes.h"
#include "engine/render/scene/material_packing.h"
#include "shaders/render/shaders.h"

namespace gloam {

void add_geometry_pass(FrameBuilder& frame, const HostGeometry* host, bool drawn_again) {
  const bool with_motion = frame.previous_instances() != nullptr;
  const SurfacePass& surfaces = geometry_surface_pass(with_motion);
  GeometryOutputs outputs;
  if (host != nullptr) {
    add_host_geometry_pass(frame, *host, drawn_again, outputs);
    if (!frame.draws().solid.empty()) {
      DrawPass pass(frame, "geometry");
      geometry_targets(pass, outputs);
      pass.use(surfaces);
      bind_motion(pass, frame.view());
      pass.surfaces(frame.draws().solid);
    }
    frame.put(outputs);
    return;
  }
  std::optional<CulledView> culled;
  if (culls_hidden(frame)) culled = add_culling_passes(frame);
  DrawPass pass(frame, "geometry");
  // Depth alone marks sky; colours are cleared only so that every texel is defined.
  const auto target = [&](const char* name, gpu::Format format) {
    return pass.target(create_view_image(frame, name, format), gpu::LoadOp::clear);
  };
  outputs.base_color = target("base_color", surfaces.color_formats[0]);
  outputs.normals = target("normals", surfaces.color_formats[1]);
  outputs.material = target("material", surfaces.color_formats[2]);
  outputs.emissive = target("emissive", surfaces.color_formats[3]);
  if (with_motion) outputs.motion = target("motion", surfaces.color_formats[4]);
  outputs.depth = culled
                      ? pass.depth_target(culled->depth, gpu::LoadOp::load)
                      : pass.depth_target(create_view_image(frame, "depth", kGeometryDepthFormat), gpu::LoadOp::clear);
  pass.use(surfaces);
  bind_motion(pass, frame.view());
  if (culled) {
    pass.surfaces(frame.draws().solid, culled->commands);
  } else {
    pass.surfaces(frame.draws().solid);
  }
  frame.put(outputs);
}

void add_sky_motion_pass(FrameBuilder& frame) {
  GeometryOutputs& outputs = frame.get<GeometryOutputs>();
  if (!outputs.motion) return;
  // Depth 0 passes the test only where nothing was drawn.
  DrawPass pass(frame, "sky_motion", {.fragment = shaders::render::sky_motion_frag});
  outputs.motion = pass.target(outputs.motion, gpu::LoadOp::load);
  pass.test_depth(outputs.depth);
  bind_motion(pass, frame.view());
  pass.draw_triangle();
}

void add_depth_bounds_pass(FrameBuilder& frame) {
  GeometryOutputs& outputs = frame.get<GeometryOutputs>();
  const ImageRef bounds = create_view_image(frame, "depth_bounds", gpu::Format::rg32_float, kTileSize);
  const gpu::ImageDesc& tiles = frame.graph().desc(bounds);
  ComputePass pass(frame, "depth_bounds", shaders::render::depth_bounds_comp);
  pass.read("depth_image", outputs.depth);
  outputs.depth_bounds = pass.write("bounds_image", bounds);
  pass.dispatch_over(tiles.width, tiles.height);
}

}  // namespace gloam
