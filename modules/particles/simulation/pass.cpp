// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/simulation/pass.h"

#include "shaders/particles/shaders.h"

namespace gloam {

ComputeProgram particle_simulation_program() { return {shaders::particles::simulate_comp}; }

void add_particle_simulation_pass(FrameBuilder& frame, ParticlesFrame& particles) {
  const std::uint64_t places = particles.constants.places;
  const auto buffer = [&](const char* name, std::uint64_t bytes) {
    gpu::BufferDesc desc;
    desc.name = name;
    desc.module = "particles";
    desc.size = bytes;
    return frame.graph().create_buffer(desc);
  };
  ComputePass pass(frame, "particle_simulation", particle_simulation_program());
  pass.read("frame", particles.constants_range);
  pass.read("emitters", particles.emitters);
  pass.read("emitter_of_group", particles.groups);
  particles.state = pass.write("particles", buffer("particles", places * sizeof(shaders::Particle)));
  particles.keys = pass.write("keys", buffer("particle_keys", places * sizeof(std::uint32_t)));
  pass.dispatch(static_cast<std::uint32_t>(places / GLOAM_PARTICLE_GROUP));
}

}  // namespace gloam
