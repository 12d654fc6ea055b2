// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/simulation/pass.h"

#include <cstddef>

#include "shaders/grass/shaders.h"

namespace gloam {

namespace {

constexpr std::uint32_t kBladeThreads = 64;  // local size of simulate_blades.comp

std::uint32_t knot_threads(SimulationThreads threads) {
  return 32u << (static_cast<std::uint32_t>(threads) - static_cast<std::uint32_t>(SimulationThreads::knots_32));
}

}  // namespace

SimulationThreads simulation_threads(SimulationThreads chosen, bool threads_in_turn) {
  if (chosen != SimulationThreads::device) return chosen;
  return threads_in_turn ? SimulationThreads::blade : SimulationThreads::knots_64;
}

std::uint32_t simulation_group_masters(SimulationThreads threads) {
  return threads == SimulationThreads::blade ? kBladeThreads : knot_threads(threads) / GLOAM_GRASS_KNOTS;
}

ComputeProgram grass_simulation_program(SimulationThreads threads, bool colliders) {
  const gpu::SpecConstant with_colliders{"kColliders", colliders};
  if (threads == SimulationThreads::blade) return {shaders::grass::simulate_blades_comp, {with_colliders}};
  return {shaders::grass::simulate_comp, {{"local_size_x", knot_threads(threads)}, with_colliders}};
}

void add_simulation_pass(FrameBuilder& frame, GrassFrame& grass, std::optional<std::uint32_t> groups) {
  ComputePass pass(frame, "grass_simulation", grass_simulation_program(grass.knobs.threads, grass.has_colliders));
  pass.uniform("steps", grass.steps);
  pass.read("patches", grass.patch_rows);
  pass.read("blade_rows", grass.store.rows);
  pass.read("types", grass.types);
  pass.read("master_list", grass.masters);
  pass.read("master_count", grass.dispatch);
  pass.read("colliders", grass.colliders);
  grass.store.knots = pass.write("knots", grass.store.knots);
  grass.store.previous_knots = pass.write("previous_knots", grass.store.previous_knots);
  if (groups) {
    if (*groups > 0) pass.dispatch(*groups);
  } else {
    pass.dispatch_indirect(grass.dispatch, offsetof(shaders::GrassDispatch, groups));
  }
}

}  // namespace gloam
