// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/simulation/pass.h"

#include <cstddef>

#include "shaders/grass/shaders.h"

namespace gloam {

ComputeProgram grass_simulation_program(std::uint32_t threads, bool colliders) {
  return {shaders::grass::simulate_comp, {{0, threads}, {1, colliders ? 1u : 0u}}};
}

void add_simulation_pass(FrameBuilder& frame, GrassFrame& grass, std::optional<std::uint32_t> groups) {
  ComputePass pass(frame, "grass_simulation", grass_simulation_program(grass.knobs.group, grass.has_colliders));
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
