// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/mirror_surfaces.h"

#include <string>

#include "shaders/reflections/shaders.h"

namespace gloam {
namespace {

BufferRef tile_buffer(FrameBuilder& frame, const char* name, std::uint64_t words) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = "reflections";
  desc.size = words * sizeof(std::uint32_t);
  return frame.graph().create_buffer(desc);
}

}  // namespace

ComputeProgram mirror_surface_program() { return {shaders::reflections::mirror_surfaces_comp}; }

void add_mirror_surface_pass(FrameBuilder& frame, ReflectionFrame& reflections) {
  const uvec2 size = reflections.constants.size;
  const uvec2 tiles = (size + std::uint32_t{GLOAM_REFLECTION_GROUP} - 1u) / std::uint32_t{GLOAM_REFLECTION_GROUP};
  reflections.tile_count = tiles.x * tiles.y;
  PassBuilder start = frame.graph().add_pass("reflection_start", frame.module());
  const BufferRef commands = start.write(tile_buffer(frame, "reflection_commands", 4), gpu::Access::transfer_write);
  const BufferRef roughness =
      start.write(tile_buffer(frame, "reflection_tile_roughness", reflections.tile_count), gpu::Access::transfer_write);
  start.execute([commands, roughness, bytes = reflections.tile_count * sizeof(std::uint32_t)](PassContext& context) {
    constexpr std::uint32_t kNoTile[] = {GLOAM_TILE_ROW, 0, 1, 0};
    for (std::uint32_t i = 0; i < 4; ++i)
      context.commands().fill_buffer(context.buffer(commands), 4 * i, 4, kNoTile[i]);
    context.commands().fill_buffer(context.buffer(roughness), 0, bytes, 0);
  });

  ComputePass pass(frame, "reflection_surfaces", mirror_surface_program());
  pass.read("reflection", reflections.block);
  read_geometry(pass, frame.get<GeometryOutputs>());
  const std::uint32_t scale = reflections.constants.scale;
  reflections.mirror_image =
      pass.write("mirror_image", create_view_image(frame, "reflection_mirrors", gpu::Format::rg32_uint, scale));
  reflections.surface =
      pass.write("surface_image", create_view_image(frame, "reflection_surface", gpu::Format::rgba8_unorm, scale));
  reflections.commands = pass.write("mirror_commands", commands);
  reflections.places = pass.write("mirror_tiles", tile_buffer(frame, "reflection_tiles", reflections.tile_count));
  reflections.tile_roughness = pass.write("tile_roughness", roughness);
  pass.dispatch_over(size);
}

void dispatch_mirror_tiles(ComputePass& pass, const ReflectionFrame& reflections) {
  if (pass.declares("mirror_image")) pass.read("mirror_image", reflections.mirror_image);
  pass.read("mirror_commands", reflections.commands);
  pass.read("mirror_tiles", reflections.places);
  pass.dispatch_indirect(reflections.commands, 0);
}

}  // namespace gloam
