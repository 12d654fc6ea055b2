// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/dof_passes.h"

#include "modules/depth_of_field/blur/blur_layers_passes.h"
#include "modules/depth_of_field/compose/compose_layers_pass.h"
#include "modules/depth_of_field/levels/levels.h"
#include "modules/depth_of_field/sprites/find_sprites_passes.h"
#include "modules/depth_of_field/tiles/list_tiles_passes.h"
#include "modules/lighting/outputs.h"

namespace gloam {

void add_dof_passes(FrameBuilder& frame, const DepthOfField& values, const Lens& lens) {
  DofInputs inputs;
  inputs.knobs = dof_knobs(frame.knobs());
  inputs.bokeh = values.bokeh;
  inputs.threads_in_turn = frame.services().device.info().threads_in_turn;
  inputs.layers_size =
      set_dof_levels({frame.view().width, frame.view().height}, inputs.knobs, inputs.bokeh, inputs.constants);
  inputs.constants.coc_offset = static_cast<float>(lens.offset_px);
  inputs.constants.coc_slope = static_cast<float>(lens.slope_px);
  set_dof_workgroups(inputs);
  inputs.block = frame.upload_uniform(inputs.constants);
  inputs.depth = front_depth(frame);
  DofFrame dof{inputs, add_dof_bounds_pass(frame, inputs)};
  const DofSprites sprites = add_dof_sprite_passes(frame, dof);
  add_dof_list_passes(frame, inputs, sprites, dof.tiles);
  const DofLayers layers = add_dof_prefilter_pass(frame, dof, sprites);
  add_dof_compose_pass(frame, dof, add_dof_gather_passes(frame, dof, layers), sprites);
  frame.put(dof);
}

void list_dof_pipelines(const DofKnobs& knobs, bool threads_in_turn, PipelineList& list) {
  const auto add = [&](const ComputeProgram& program) { list.push_back(pipeline_desc(program, "depth_of_field")); };
  for (const ComputeProgram& program :
       {dof_reset_program(), dof_bounds_program(), dof_find_sprites_program(), dof_reach_sprites_program()})
    add(program);
  for (const std::uint32_t kind :
       {GLOAM_DOF_COMPOSE_ONE, GLOAM_DOF_COMPOSE_ONE + 1, GLOAM_DOF_COMPOSE_TWO, GLOAM_DOF_COMPOSE_FAR,
        GLOAM_DOF_COMPOSE_NEAR_FINE, GLOAM_DOF_COMPOSE_NEAR, GLOAM_DOF_COMPOSE_BOTH})
    add(dof_compose_program(Bokeh::round, kind, knobs.full_resolution, threads_in_turn));
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
    add(dof_reach_program(bokeh));
    add(dof_list_program(bokeh));
    for (const bool second : {false, true}) {
      add(dof_prefilter_program(bokeh, second, false, threads_in_turn));
      if (knobs.full_resolution) add(dof_prefilter_program(bokeh, second, true, threads_in_turn));
      add(dof_gather_program(knobs.cache, bokeh, second, threads_in_turn));
    }
    add(dof_compose_program(bokeh, GLOAM_DOF_COMPOSE_SPRITES, knobs.full_resolution, threads_in_turn));
  }
}

}  // namespace gloam
