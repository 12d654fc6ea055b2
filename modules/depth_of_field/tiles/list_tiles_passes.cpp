// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/tiles/list_tiles_passes.h"

#include "shaders/depth_of_field/shaders.h"

namespace gloam {
namespace {

BufferRef words(FrameBuilder& frame, const char* name, std::uint64_t count) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = frame.module();
  desc.size = count * sizeof(std::uint32_t);
  return frame.graph().create_buffer(desc);
}

}  // namespace

ComputeProgram dof_bounds_program() { return {shaders::depth_of_field::bounds_comp}; }
ComputeProgram dof_reach_program() { return {shaders::depth_of_field::reach_comp}; }
ComputeProgram dof_list_program(std::uint32_t scale, Bokeh bokeh) {
  return {shaders::depth_of_field::list_comp, {{"kScale", scale}, {"kRound", bokeh == Bokeh::round ? 1u : 0u}}};
}

DofTiles add_dof_tile_passes(FrameBuilder& frame, const DofInputs& inputs) {
  const uvec2 size = inputs.constants.tiles;
  DofTiles tiles;
  ComputePass bounds(frame, "dof_tile_bounds", dof_bounds_program());
  bounds.read("dof", inputs.block);
  bounds.read("depth_image", inputs.depth);
  const ImageRef tile =
      bounds.write("tile_image", create_view_image(frame, "dof_tile_bounds", gpu::Format::rg32_float, GLOAM_DOF_TILE));
  const BufferRef empty_lists = bounds.write(
      "lists", words(frame, "dof_lists", GLOAM_DOF_LISTS * sizeof(shaders::DofList) / sizeof(std::uint32_t)));
  bounds.dispatch_over(glm::max(size, uvec2(GLOAM_DOF_LISTS, 1)));

  ComputePass reach(frame, "dof_tile_reach", dof_reach_program());
  reach.read("dof", inputs.block);
  reach.read("tile_image", tile);
  tiles.reach =
      reach.write("reach_image", create_view_image(frame, "dof_tile_reach", gpu::Format::rgba16_float, GLOAM_DOF_TILE));
  reach.dispatch_over(size);

  const std::uint64_t count = std::uint64_t{size.x} * size.y;
  ComputePass list(frame, "dof_tile_lists", dof_list_program(inputs.scale(), inputs.bokeh));
  list.read("dof", inputs.block);
  list.read("reach_image", tiles.reach);
  tiles.lists = list.write("lists", empty_lists);
  tiles.entries = list.write("entries", words(frame, "dof_list_entries", GLOAM_DOF_LISTS * count));
  tiles.flags = list.write("tile_flags", words(frame, "dof_tile_flags", count));
  list.dispatch_over(size);
  return tiles;
}

void read_dof_lists(ComputePass& pass, const DofTiles& tiles) {
  pass.read("lists", tiles.lists);
  pass.read("entries", tiles.entries);
}

void dispatch_dof_list(ComputePass& pass, const DofTiles& tiles, std::uint32_t list) {
  pass.dispatch_indirect(tiles.lists, list * sizeof(shaders::DofList));
}

}  // namespace gloam
