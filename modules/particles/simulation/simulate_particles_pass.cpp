// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/simulation/simulate_particles_pass.h"

#include <algorithm>

#include "shaders/particles/shaders.h"

namespace gloam {

ComputeProgram particle_simulation_program(bool one_emitter, bool paths) {
  return {shaders::particles::simulate_comp, {{"kOneEmitter", one_emitter ? 1u : 0u}, {"kPaths", paths ? 1u : 0u}}};
}

std::vector<SimulationDispatch> simulation_dispatches(std::span<const std::uint32_t> emitter_of_group) {
  std::vector<SimulationDispatch> dispatches;
  std::uint32_t own = 0;
  for (std::size_t begin = 0, end = 0; begin < emitter_of_group.size(); begin = end) {
    const std::uint32_t row = emitter_of_group[begin];
    while (end < emitter_of_group.size() && emitter_of_group[end] == row) ++end;
    const auto first = static_cast<std::uint32_t>(begin), groups = static_cast<std::uint32_t>(end - begin);
    const bool one_emitter = groups >= kLeastOwnGroups && own < kMostOwnDispatches;
    own += one_emitter ? 1 : 0;
    if (!one_emitter && !dispatches.empty() && !dispatches.back().one_emitter) {
      dispatches.back().groups += groups;
    } else {
      dispatches.push_back({{first, row}, groups, one_emitter});
    }
  }
  return dispatches;
}

namespace {

void add_dispatches(ComputePass& pass, const ParticleInputs& inputs, bool one_emitter, bool paths,
                    SimulatedParticles& simulated) {
  const auto is_meant = [&](const SimulationDispatch& dispatch) {
    return dispatch.one_emitter == one_emitter && dispatch.paths == paths;
  };
  if (std::ranges::none_of(inputs.dispatches, is_meant)) return;
  pass.use(particle_simulation_program(one_emitter, paths));
  pass.read("frame", inputs.constants_range);
  pass.read("emitters", inputs.emitters);
  pass.read_if_declared("emitter_of_group", inputs.groups);
  pass.read_if_declared("poses", inputs.poses);
  simulated.state = pass.write("particles", simulated.state);
  simulated.keys = pass.write("keys", simulated.keys);
  for (const SimulationDispatch& dispatch : inputs.dispatches) {
    if (!is_meant(dispatch)) continue;
    pass.push(dispatch.constants);
    pass.dispatch(dispatch.groups);
  }
}

}  // namespace

SimulatedParticles add_particle_simulation_pass(FrameBuilder& frame, const ParticleInputs& inputs) {
  const std::uint64_t places = inputs.constants.places;
  const auto buffer = [&](const char* name, std::uint64_t bytes) {
    gpu::BufferDesc desc;
    desc.name = name;
    desc.module = "particles";
    desc.size = bytes;
    return frame.graph().create_buffer(desc);
  };
  ComputePass pass(frame, "particle_simulation", particle_simulation_program(true, false));
  SimulatedParticles simulated;
  simulated.state = buffer("particles", places * sizeof(shaders::Particle));
  simulated.keys = buffer("particle_keys", places * sizeof(std::uint32_t));
  for (const bool one_emitter : {true, false})
    for (const bool paths : {false, true}) add_dispatches(pass, inputs, one_emitter, paths, simulated);
  return simulated;
}

}  // namespace gloam
