// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/tiles/list_tiles_passes.h"

#include "shaders/depth_of_field/shaders.h"

namespace gloam {
namespace {

BufferRef buffer_of(FrameBuilder& frame, const char* name, std::uint64_t bytes) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = frame.module();
  desc.size = bytes;
  return frame.graph().create_buffer(desc);
}

}  // namespace

ComputeProgram dof_reset_program() { return {shaders::depth_of_field::reset_comp}; }
ComputeProgram dof_bounds_program() { return {shaders::depth_of_field::bounds_comp}; }
ComputeProgram dof_reach_program(Bokeh bokeh) {
  return {shaders::depth_of_field::reach_comp, {{"kHexagonal", dof_hexagonal(bokeh)}}};
}
ComputeProgram dof_list_program(Bokeh bokeh) {
  return {shaders::depth_of_field::list_comp, {{"kHexagonal", dof_hexagonal(bokeh)}}};
}

BufferRef dof_tile_buffer(FrameBuilder& frame, const DofInputs& inputs, const char* name, std::uint64_t size) {
  return buffer_of(frame, name, std::uint64_t{inputs.constants.tiles.x} * inputs.constants.tiles.y * size);
}

DofTiles add_dof_bounds_pass(FrameBuilder& frame, const DofInputs& inputs) {
  DofTiles tiles;
  ComputePass bounds(frame, "dof_tile_bounds", dof_reset_program());
  tiles.lists = bounds.write("lists", buffer_of(frame, "dof_lists", GLOAM_DOF_LISTS * sizeof(shaders::DofList)));
  tiles.picture = bounds.write("picture", buffer_of(frame, "dof_picture", sizeof(shaders::DofPictureBounds)));
  bounds.dispatch(1);
  bounds.barrier();
  bounds.use(dof_bounds_program());
  bounds.read("dof", inputs.block);
  bounds.read("depth_image", inputs.depth);
  tiles.bounds =
      bounds.write("bounds", dof_tile_buffer(frame, inputs, "dof_tile_bounds", sizeof(shaders::DofTileBounds)));
  bounds.dispatch_over(inputs.constants.tiles);
  return tiles;
}

void add_dof_list_passes(FrameBuilder& frame, const DofInputs& inputs, const DofSprites& sprites, DofTiles& tiles) {
  const uvec2 size = inputs.constants.tiles;
  ComputePass reach(frame, "dof_tile_reach", dof_reach_program(inputs.bokeh));
  reach.read("dof", inputs.block);
  reach.read("bounds", tiles.bounds);
  reach.read("picture", tiles.picture);
  tiles.reach = reach.write("reached", dof_tile_buffer(frame, inputs, "dof_tile_reach", sizeof(shaders::DofTileReach)));
  reach.dispatch_over(size);

  ComputePass list(frame, "dof_tile_lists", dof_list_program(inputs.bokeh));
  list.read("dof", inputs.block);
  list.read("bounds", tiles.bounds);
  list.read("reached", tiles.reach);
  list.read("picture", tiles.picture);
  list.read("tile_sprites", sprites.tiles);
  list.read("reaching", sprites.reaching);
  tiles.lists = list.write("lists", tiles.lists);
  tiles.entries = list.write(
      "entries", dof_tile_buffer(frame, inputs, "dof_list_entries", GLOAM_DOF_LISTS * sizeof(shaders::DofEntry)));
  list.dispatch_over(size);
}

void read_dof_lists(ComputePass& pass, const DofTiles& tiles) {
  pass.read("lists", tiles.lists);
  pass.read("entries", tiles.entries);
}

void dispatch_dof_list(ComputePass& pass, const DofTiles& tiles, std::uint32_t list) {
  pass.dispatch_indirect(tiles.lists, list * sizeof(shaders::DofList));
}

}  // namespace gloam
