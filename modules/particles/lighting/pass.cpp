// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/lighting/pass.h"

#include <cstddef>

#include "shaders/particles/shaders.h"

namespace gloam {

ParticleLightVersion particle_light_version(const FrameBuilder& frame, const ParticlesFrame& particles) {
  ParticleLightVersion version;
  const ShadowsOutputs* shadows = frame.find<ShadowsOutputs>();
  version.cookies = shadows != nullptr && shadows->cookie_lights > 0;
  version.constants = {{"kMaps", particles.atlas.visibility ? 1u : 0u}};
  if (version.cookies) version.constants.set(shadows->constants);
  return version;
}

ComputeProgram particle_light_program(const ParticleLightVersion& version, std::uint32_t lit_points) {
  ComputeProgram program{version.cookies ? shaders::particles::light_cookies_comp : shaders::particles::light_comp,
                         version.constants};
  program.constants.set("kLitPoints", lit_points);
  return program;
}

void read_particle_light(ShaderPass& pass, FrameBuilder& frame, const ParticlesFrame& particles) {
  pass.read_if_declared("flux_red", particles.atlas.flux[0], Sampling::linear);
  pass.read_if_declared("flux_green", particles.atlas.flux[1], Sampling::linear);
  pass.read_if_declared("flux_blue", particles.atlas.flux[2], Sampling::linear);
  pass.read_if_declared("baked_visibility", particles.atlas.visibility, Sampling::linear);
  read_lighting(pass, frame);
}

void add_particle_light_pass(FrameBuilder& frame, ParticlesFrame& particles) {
  gpu::BufferDesc desc;
  desc.name = "particle_light";
  desc.module = "particles";
  desc.size = std::uint64_t{particles.particles} * particles.lit_points() * sizeof(uvec2);
  const ParticleLightVersion version = particle_light_version(frame, particles);
  ComputePass pass(frame, "particle_light", particle_light_program(version, particles.lit_points()));
  pass.read("frame", particles.constants_range);
  pass.read("emitters", particles.emitters);
  pass.read("particles", particles.state);
  pass.read("order", particles.order);
  pass.read("draws", particles.draws);
  read_particle_light(pass, frame, particles);
  particles.light = pass.write("light", frame.graph().create_buffer(desc));
  pass.dispatch_indirect(particles.draws, offsetof(shaders::ParticleDraws, light_groups));
}

}  // namespace gloam
