// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/drawing/draw_sprites_pass.h"

#include "engine/render/declare/kept_indices.h"
#include "shaders/particles/shaders.h"

namespace gloam {

std::vector<std::uint32_t> sprite_indices() {
  std::vector<std::uint32_t> indices;
  for (std::uint32_t sprite = 0; sprite < GLOAM_PARTICLE_DRAW_SPRITES; ++sprite)
    for (const std::uint32_t corner : {0u, 1u, 3u, 0u, 3u, 2u}) indices.push_back(4 * sprite + corner);
  return indices;
}

DrawProgram sprite_program(std::uint32_t lit_points, bool clipped, bool jittered, const ParticleLightVersion* version) {
  DrawProgram program{.fragment = shaders::particles::sprite_frag,
                      .blend = jittered ? gpu::BlendMode::premultiplied_over : gpu::BlendMode::premultiplied,
                      .vertex = shaders::particles::sprite_vert};
  if (version != nullptr) {
    program.fragment =
        version->cookies ? shaders::particles::sprite_pixel_cookies_frag : shaders::particles::sprite_pixel_frag;
    program.constants = version->constants;
  }
  program.constants.set("kLitPoints", lit_points);
  program.constants.set("kClipped", clipped ? 1u : 0u);
  return program;
}

BufferRef sprite_index_buffer(FrameBuilder& frame) { return kept_indices(frame, "particle_indices", sprite_indices()); }

void draw_sprites(DrawPass& pass, FrameBuilder& frame, const ParticlesFrame& particles, BufferRef indices) {
  pass.read("frame", particles.inputs.constants_range);
  pass.read("emitters", particles.inputs.emitters);
  pass.read("particles", particles.simulated.state);
  pass.read("order", particles.sorted.order);
  pass.read("draws", particles.sorted.draws);
  pass.read("light", particles.light);
  pass.read("depth_image", frame.get<GeometryOutputs>().depth);
  pass.draw_indexed_indirect(indices, particles.sorted.draws, 0, 1);
}

void add_sprite_pass(FrameBuilder& frame, const ParticlesFrame& particles) {
  const BufferRef indices = sprite_index_buffer(frame);
  if (!frame.status().ok()) return;
  const ParticleLighting lighting = particles.inputs.lighting;
  const bool per_pixel = lighting == ParticleLighting::pixel;
  const ParticleLightVersion version = particle_light_version(frame, particles.inputs.atlas);
  LitOutput& lit = frame.get<LitOutput>();
  DrawPass pass(frame, "particle_sprites",
                sprite_program(lit_points(lighting), frame.view().clipped, frame.view().jittered,
                               per_pixel ? &version : nullptr));
  lit.color = pass.target(lit.color, gpu::LoadOp::load);
  pass.test_depth(frame.get<GeometryOutputs>().depth);
  if (per_pixel) read_particle_light(pass, frame, particles.inputs.atlas);
  draw_sprites(pass, frame, particles, indices);
}

}  // namespace gloam
