// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/render/declare/draw_pass.h"
#include "engine/render/passes/renderer_passes.h"
#include "shaders/render/gbuffer/smooth_surface_shared.h"
#include "shaders/render/shaders.h"

namespace gloam {
namespace {

/// Binds the draw's vertices and triangles as storage buffers. Returns the first index within the bound range, whose
/// start is aligned for binding.
std::uint32_t bind_mesh(DrawPass& pass, FrameBuilder& frame, const Draw& draw) {
  constexpr std::uint32_t kIndexAlign = 64;
  const GpuScene& scene = frame.scene();
  const std::uint64_t count = draw.primitive->vertex_count;
  if (draw.deform == kNone) {
    const std::uint64_t first = draw.primitive->first_vertex;
    pass.read("mesh_positions",
              gpu::Binding::BufferRange{scene.positions(), first * sizeof(vec3), count * sizeof(vec3)});
    pass.read("mesh_frames",
              gpu::Binding::BufferRange{scene.frames(), first * sizeof(PackedFrame), count * sizeof(PackedFrame)});
  } else {
    const FrameBuilder::Deformed& deformed = *frame.shared().find<FrameBuilder::Deformed>();
    const std::uint64_t first = frame.frame_draws().deforms[draw.deform].first_vertex;
    pass.read_part("mesh_positions", deformed.positions, first * sizeof(vec3), count * sizeof(vec3));
    pass.read_part("mesh_frames", deformed.frames, first * sizeof(PackedFrame), count * sizeof(PackedFrame));
  }
  const std::uint32_t start = draw.first_index / kIndexAlign * kIndexAlign;
  constexpr std::uint64_t kWord = sizeof(std::uint32_t);
  pass.read("mesh_indices", gpu::Binding::BufferRange{scene.indices(), start * kWord,
                                                      (draw.first_index + draw.index_count - start) * kWord});
  return draw.first_index - start;
}

}  // namespace

void add_smooth_surface_pass(FrameBuilder& frame) {
  if (!frame.scene().has_smooth_shading()) return;
  GeometryOutputs& outputs = frame.get<GeometryOutputs>();
  DrawPass pass(frame, "smooth_surfaces",
                {.fragment = shaders::render::smooth_surface_frag, .vertex = shaders::render::smooth_surface_vert});
  outputs.smooth_surfaces =
      pass.target(create_view_image(frame, "smooth_surfaces", gpu::Format::rg32_uint), gpu::LoadOp::clear);
  read_geometry(pass, outputs);
  for (const Draw& draw : frame.draws().solid) {
    if (!draw.primitive->smooth_shaded) continue;
    shaders::SmoothSurfaceConstants constants{};
    constants.draw = draw.constants;
    constants.first_index = bind_mesh(pass, frame, draw);
    pass.push(constants);
    pass.draw(draw.index_count, 1);
  }
  frame.expose(outputs.smooth_surfaces);
}

}  // namespace gloam
