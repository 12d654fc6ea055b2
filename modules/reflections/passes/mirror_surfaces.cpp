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

MirrorSurfaces add_mirror_surface_pass(FrameBuilder& frame, const ReflectionUniforms& uniforms) {
  const uvec2 size = uniforms.constants.size;
  const uvec2 groups = (size + std::uint32_t{GLOAM_REFLECTION_GROUP} - 1u) / std::uint32_t{GLOAM_REFLECTION_GROUP};
  const std::uint32_t count = groups.x * groups.y;
  PassBuilder start = frame.graph().add_pass("reflection_start", frame.module());
  const BufferRef commands = start.write(tile_buffer(frame, "reflection_commands", 4), gpu::Access::transfer_write);
  const BufferRef roughness =
      start.write(tile_buffer(frame, "reflection_tile_roughness", count), gpu::Access::transfer_write);
  start.execute([commands, roughness, bytes = count * sizeof(std::uint32_t)](PassContext& context) {
    constexpr std::uint32_t kNoTile[] = {GLOAM_TILE_ROW, 0, 1, 0};
    for (std::uint32_t i = 0; i < 4; ++i)
      context.commands().fill_buffer(context.buffer(commands), 4 * i, 4, kNoTile[i]);
    context.commands().fill_buffer(context.buffer(roughness), 0, bytes, 0);
  });

  MirrorSurfaces found;
  ComputePass pass(frame, "reflection_surfaces", mirror_surface_program());
  pass.read("reflection", uniforms.block);
  read_geometry(pass, frame.get<GeometryOutputs>());
  const std::uint32_t scale = uniforms.constants.scale;
  found.tiles.image =
      pass.write("mirror_image", create_view_image(frame, "reflection_mirrors", gpu::Format::rg32_uint, scale));
  found.surface =
      pass.write("surface_image", create_view_image(frame, "reflection_surface", gpu::Format::rgba8_unorm, scale));
  found.tiles.commands = pass.write("mirror_commands", commands);
  found.tiles.places = pass.write("mirror_tiles", tile_buffer(frame, "reflection_tiles", count));
  found.tiles.roughness = pass.write("tile_roughness", roughness);
  found.tiles.count = count;
  pass.dispatch_over(size);
  return found;
}

void dispatch_mirror_tiles(ComputePass& pass, const MirrorTiles& tiles) {
  if (pass.declares("mirror_image")) pass.read("mirror_image", tiles.image);
  pass.read("mirror_commands", tiles.commands);
  pass.read("mirror_tiles", tiles.places);
  pass.dispatch_indirect(tiles.commands, 0);
}

}  // namespace gloam
