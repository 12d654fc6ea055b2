// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/compose/compose_layers_pass.h"

#include "modules/depth_of_field/tiles/list_tiles_passes.h"
#include "shaders/depth_of_field/shaders.h"

namespace gloam {

ComputeProgram dof_compose_program(std::uint32_t scale, bool near, bool in_turn) {
  const std::int32_t rows = in_turn ? GLOAM_DOF_BLOCK : 1;
  return {shaders::depth_of_field::compose_comp,
          {{"kScale", scale},
           {"kNear", near ? 1u : 0u},
           {"kRows", rows},
           {"local_size_y", static_cast<std::uint32_t>(GLOAM_DOF_BLOCK / rows)}}};
}

void add_dof_compose_pass(FrameBuilder& frame, const DofFrame& dof, const DofLayers& blurred) {
  const bool in_turn = frame.services().device.info().threads_in_turn;
  ComputePass pass(frame, "dof_compose", dof_compose_program(dof.inputs.scale(), false, in_turn));
  LitOutput& lit = frame.get<LitOutput>();
  pass.read("dof", dof.inputs.block);
  pass.read("depth_image", dof.inputs.depth);
  pass.read("far_image", blurred.far);
  pass.read("near_image", blurred.near);
  pass.read("beyond_image", blurred.beyond);
  pass.read("reach_image", dof.tiles.reach);
  lit.color = pass.write("lit_image", lit.color);
  read_dof_lists(pass, dof.tiles);
  dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_COMPOSE_FAR);
  pass.use(dof_compose_program(dof.inputs.scale(), true, in_turn));
  dispatch_dof_list(pass, dof.tiles, GLOAM_DOF_COMPOSE_BOTH);
}

}  // namespace gloam
