// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/compose/compose_layers_pass.h"

#include "modules/depth_of_field/tiles/list_tiles_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/depth_of_field/shaders.h"

namespace gloam {

ComputeProgram dof_compose_program(Bokeh bokeh, bool near) {
  return {shaders::depth_of_field::compose_comp, dof_constants(bokeh, "kNear", near, false)};
}

void add_dof_compose_pass(FrameBuilder& frame, const DofFrame& dof, const DofLayers& gathered,
                          const DofSprites& sprites) {
  ComputePass pass(frame, "dof_compose", dof_compose_program(dof.inputs.bokeh, false));
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
  dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_COMPOSE_FAR);
  pass.use(dof_compose_program(dof.inputs.bokeh, true));
  dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_COMPOSE_BOTH);
}

}  // namespace gloam
