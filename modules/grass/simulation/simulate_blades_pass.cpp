// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/simulation/simulate_blades_pass.h"

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

GrassStore add_simulation_pass(FrameBuilder& frame, const GrassInputs& inputs, const GrassStore& store,
                               const MasterList& list, std::optional<std::uint32_t> groups) {
  ComputePass pass(frame, "grass_simulation", grass_simulation_program(inputs.threads, inputs.has_colliders));
  pass.uniform("steps", inputs.steps);
  pass.read("patches", inputs.patch_rows);
  pass.read("blade_rows", store.rows);
  pass.read("types", inputs.types);
  pass.read("master_list", list.masters);
  pass.read("master_count", list.dispatch);
  pass.read("colliders", inputs.colliders);
  GrassStore after{.rows = store.rows, .stamps = list.stamps};
  after.knots = pass.write("knots", store.knots);
  after.previous_knots = pass.write("previous_knots", store.previous_knots);
  if (groups) {
    if (*groups > 0) pass.dispatch(*groups);
  } else {
    pass.dispatch_indirect(list.dispatch, offsetof(shaders::GrassDispatch, groups));
  }
  return after;
}

}  // namespace gloam
