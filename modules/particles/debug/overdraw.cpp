// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/debug/overdraw.h"

#include "engine/render/passes/visualizer_pass.h"
#include "modules/particles/drawing/draw_sprites_pass.h"
#include "shaders/particles/shaders.h"

namespace gloam {

std::vector<VisualizerInfo> particle_visualizers() {
  VisualizerInfo view = {"overdraw", "particles", "", "sprites at each pixel"};
  view.heat = {.most = 63.0, .counts = true};
  return {view};
}

void add_overdraw_passes(FrameBuilder& frame, const ParticlesFrame* particles) {
  if (frame.visualizer() != "overdraw" || particles == nullptr) return;
  const BufferRef indices = sprite_index_buffer(frame);
  if (!frame.status().ok()) return;
  DrawProgram program = sprite_program(0, frame.view().clipped, false, nullptr);
  program.fragment = shaders::particles::overdraw_count_frag;
  program.blend = gpu::BlendMode::additive;
  DrawPass count(frame, "particle_overdraw", program);
  const ImageRef layers =
      count.target(create_view_image(frame, "particle_layers", gpu::Format::rgba16_float), gpu::LoadOp::clear);
  count.test_depth(frame.get<GeometryOutputs>().depth);
  draw_sprites(count, frame, *particles, indices);

  DrawPass view(frame, "overdraw_view", {shaders::particles::overdraw_view_frag, visualizer_constants(frame)});
  view.read("layers", layers);
  add_visualizer_targets(frame, view, "overdraw", gpu::Format::rgba16_float, gpu::LoadOp::clear);
  view.draw_triangle();
}

}  // namespace gloam
