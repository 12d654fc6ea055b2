// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/lighting/light_sprites_pass.h"

#include <cstddef>

#include "shaders/particles/shaders.h"

namespace gloam {

ParticleLightVersion particle_light_version(const FrameBuilder& frame, const BakedLightAtlas& atlas) {
  ParticleLightVersion version;
  const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
  version.cookies = shadows != nullptr && shadows->cookie_lights > 0;
  version.constants = {{"kMaps", atlas.visibility ? 1u : 0u}};
  if (version.cookies) version.constants.set(shadows->constants);
  version.constants.set(indirect_constants(frame));
  return version;
}

ComputeProgram particle_light_program(const ParticleLightVersion& version, std::uint32_t lit_points) {
  ComputeProgram program{version.cookies ? shaders::particles::light_cookies_comp : shaders::particles::light_comp,
                         version.constants};
  program.constants.set("kLitPoints", lit_points);
  return program;
}

void read_particle_light(ShaderPass& pass, FrameBuilder& frame, const BakedLightAtlas& atlas) {
  pass.read_if_declared("flux_red", atlas.flux[0], Sampling::linear);
  pass.read_if_declared("flux_green", atlas.flux[1], Sampling::linear);
  pass.read_if_declared("flux_blue", atlas.flux[2], Sampling::linear);
  pass.read_if_declared("baked_visibility", atlas.visibility, Sampling::linear);
  read_lighting(pass, frame);
}

BufferRef add_particle_light_pass(FrameBuilder& frame, const ParticleInputs& inputs,
                                  const SimulatedParticles& simulated, const SortedParticles& sorted) {
  const std::uint32_t points = lit_points(inputs.lighting);
  gpu::BufferDesc desc;
  desc.name = "particle_light";
  desc.module = "particles";
  desc.size = std::uint64_t{inputs.particles} * points * sizeof(uvec2);
  const ParticleLightVersion version = particle_light_version(frame, inputs.atlas);
  ComputePass pass(frame, "particle_light", particle_light_program(version, points));
  pass.read("frame", inputs.constants_range);
  pass.read("emitters", inputs.emitters);
  pass.read("particles", simulated.state);
  pass.read("order", sorted.order);
  pass.read("draws", sorted.draws);
  read_particle_light(pass, frame, inputs.atlas);
  const BufferRef light = pass.write("light", frame.graph().create_buffer(desc));
  pass.dispatch_indirect(sorted.draws, offsetof(shaders::ParticleDraws, light_groups));
  return light;
}

}  // namespace gloam
