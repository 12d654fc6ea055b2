// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/sprites/find_sprites_passes.h"

#include "modules/depth_of_field/tiles/list_tiles_passes.h"
#include "modules/lighting/outputs.h"
#include "shaders/depth_of_field/shaders.h"

namespace gloam {

ComputeProgram dof_find_sprites_program() { return {shaders::depth_of_field::find_sprites_comp}; }
ComputeProgram dof_reach_sprites_program() { return {shaders::depth_of_field::reach_sprites_comp}; }

DofSprites add_dof_sprite_passes(FrameBuilder& frame, DofFrame& dof) {
  const DofInputs& inputs = dof.inputs;
  DofSprites sprites;
  ComputePass find(frame, "dof_sprites_find", dof_find_sprites_program());
  find.read("dof", inputs.block);
  find.read("depth_image", inputs.depth);
  find.read("lit_image", frame.get<LitOutput>().color);
  find.read("bounds", dof.tiles.bounds);
  sprites.tiles =
      find.write("tile_sprites", dof_tile_buffer(frame, inputs, "dof_tile_sprites", sizeof(shaders::DofTileSprites)));
  sprites.sprites = find.write(
      "sprites", dof_tile_buffer(frame, inputs, "dof_sprites", GLOAM_DOF_TILE_SPRITES * sizeof(shaders::DofSprite)));
  dof.tiles.lists = find.write("lists", dof.tiles.lists);
  find.dispatch_over(inputs.constants.tiles);

  ComputePass reach(frame, "dof_sprites_reach", dof_reach_sprites_program());
  reach.read("dof", inputs.block);
  reach.read("tile_sprites", sprites.tiles);
  reach.read("sprites", sprites.sprites);
  reach.read("picture", dof.tiles.picture);
  sprites.reaching = reach.write("reaching", dof_tile_buffer(frame, inputs, "dof_sprites_reaching",
                                                             (GLOAM_DOF_REACHING_SPRITES + 1) * sizeof(std::uint32_t)));
  dof.tiles.lists = reach.write("lists", dof.tiles.lists);
  reach.dispatch_over(inputs.constants.tiles);
  return sprites;
}

}  // namespace gloam
