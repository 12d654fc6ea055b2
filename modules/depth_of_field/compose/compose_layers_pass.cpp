// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/compose/compose_layers_pass.h"

#include "modules/depth_of_field/tiles/list_tiles_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/depth_of_field/shaders.h"

namespace gloam {

ComputeProgram dof_compose_program(Bokeh bokeh, std::uint32_t kind, bool full_resolution, bool threads_in_turn) {
  return {shaders::depth_of_field::compose_comp,
          {// Only sprites have the shape of the aperture.
           {"kHexagonal", kind == GLOAM_DOF_COMPOSE_SPRITES ? dof_hexagonal(bokeh) : 0u},
           {"kKind", kind},
           {"kThreads", dof_threads(threads_in_turn)},
           {"kFull", full_resolution ? 1u : 0u}}};
}

void add_dof_compose_pass(FrameBuilder& frame, const DofFrame& dof, const DofLayers& gathered,
                          const DofSprites& sprites) {
  const auto program = [&](std::uint32_t kind) {
    return dof_compose_program(dof.inputs.bokeh, kind, dof.inputs.knobs.full_resolution, dof.inputs.threads_in_turn);
  };
  ComputePass pass(frame, "dof_compose", program(GLOAM_DOF_COMPOSE_FAR));
  LitOutput& lit = frame.get<LitOutput>();
  pass.read("dof", dof.inputs.block);
  pass.read("depth_image", dof.inputs.depth);
  pass.read("far_image", gathered.far);
  pass.read("near_image", gathered.near);
  pass.read("reached", dof.tiles.reach);
  pass.read("tile_sprites", sprites.tiles);
  pass.read("sprites", sprites.sprites);
  pass.read("reaching", sprites.reaching);
  lit.color = pass.write("lit_image", lit.color);
  read_dof_lists(pass, dof.tiles);
  const auto run = [&](std::uint32_t kind, std::uint32_t list, int level) {
    pass.use(program(kind));
    pass.push(shaders::DofLevel{level});
    dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_COMPOSE + list);
  };
  for (int k = 1; k <= dof.inputs.constants.last_level; ++k) {
    const auto level = static_cast<std::uint32_t>(k);
    run(GLOAM_DOF_COMPOSE_ONE + (k > 1 ? 1 : 0), GLOAM_DOF_COMPOSE_ONE + level, k);
    if (k > 1 && k < dof.inputs.constants.last_level) run(GLOAM_DOF_COMPOSE_TWO, GLOAM_DOF_COMPOSE_TWO + level, k);
  }
  for (std::uint32_t kind = GLOAM_DOF_COMPOSE_FAR; kind < GLOAM_DOF_COMPOSE_KINDS; ++kind) run(kind, kind, 0);
}

}  // namespace gloam
