// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/compose/compose_layers_pass.h"

#include "modules/depth_of_field/tiles/list_tiles_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/depth_of_field/shaders.h"

namespace gloam {

ComputeProgram dof_compose_program(Bokeh bokeh, std::uint32_t kind, bool full_resolution) {
  return {shaders::depth_of_field::compose_comp,
          {// Only sprites have the shape of the aperture.
           {"kHexagonal", kind == GLOAM_DOF_COMPOSE_SPRITES ? dof_hexagonal(bokeh) : 0u},
           {"kKind", kind},
           {"kThreads", GLOAM_DOF_THREADS},
           {"kFull", full_resolution ? 1u : 0u}}};
}

void add_dof_compose_pass(FrameBuilder& frame, const DofFrame& dof, const DofLayers& gathered,
                          const DofSprites& sprites) {
  const auto program = [&](std::uint32_t kind) {
    return dof_compose_program(dof.inputs.bokeh, kind, dof.inputs.knobs.full_resolution);
  };
  ComputePass pass(frame, "dof_compose", program(0));
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
  for (std::uint32_t kind = 0; kind < GLOAM_DOF_COMPOSE_KINDS; ++kind) {
    pass.use(program(kind));
    dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_COMPOSE + kind);
  }
}

}  // namespace gloam
