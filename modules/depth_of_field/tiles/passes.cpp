// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/tiles/passes.h"

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
ComputeProgram dof_list_program(std::uint32_t scale) {
  return {shaders::depth_of_field::list_comp, {{"kScale", scale}}};
}

void add_dof_tile_passes(FrameBuilder& frame, DofFrame& dof) {
  const uvec2 tiles = dof.constants.tiles;
  ComputePass bounds(frame, "dof_tile_bounds", dof_bounds_program());
  bounds.read("dof", dof.block);
  bounds.read("depth_image", dof.depth);
  const ImageRef tile =
      bounds.write("tile_image", create_view_image(frame, "dof_tile_bounds", gpu::Format::rg32_float, GLOAM_DOF_TILE));
  dof.lists = bounds.write(
      "lists", words(frame, "dof_lists", GLOAM_DOF_LISTS * sizeof(shaders::DofList) / sizeof(std::uint32_t)));
  bounds.dispatch_over(glm::max(tiles, uvec2(GLOAM_DOF_LISTS, 1)));

  ComputePass reach(frame, "dof_tile_reach", dof_reach_program());
  reach.read("dof", dof.block);
  reach.read("tile_image", tile);
  dof.reach =
      reach.write("reach_image", create_view_image(frame, "dof_tile_reach", gpu::Format::rgba16_float, GLOAM_DOF_TILE));
  reach.dispatch_over(tiles);

  const std::uint64_t count = std::uint64_t{tiles.x} * tiles.y;
  ComputePass list(frame, "dof_tile_lists", dof_list_program(dof.scale()));
  list.read("dof", dof.block);
  list.read("reach_image", dof.reach);
  dof.lists = list.write("lists", dof.lists);
  dof.entries = list.write("entries", words(frame, "dof_list_entries", GLOAM_DOF_LISTS * count));
  dof.flags = list.write("tile_flags", words(frame, "dof_tile_flags", count));
  list.dispatch_over(tiles);
}

void read_dof_lists(ComputePass& pass, const DofFrame& dof) {
  pass.read("lists", dof.lists);
  pass.read("entries", dof.entries);
}

void dispatch_dof_list(ComputePass& pass, const DofFrame& dof, std::uint32_t list) {
  pass.dispatch_indirect(dof.lists, list * sizeof(shaders::DofList));
}

}  // namespace gloam
