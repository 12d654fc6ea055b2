// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/passes/mirror_surfaces.h"

#include <algorithm>
#include <string>

#include "modules/lighting/outputs.h"
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

// Parts of a buffer begin at multiples of this many words, as devices ask for.
constexpr std::uint32_t kPartWords = 64;

/// Empties the buffers that the passes count in.
void start_lists(FrameBuilder& frame, MirrorTiles& tiles) {
  tiles.lists = {.tiles = tiles.count,
                 .command_words = kPartWords,
                 .place_words = (tiles.count + kPartWords - 1) / kPartWords * kPartWords};
  const std::uint32_t words = GLOAM_TILE_LISTS * kPartWords;
  PassBuilder start = frame.graph().add_pass("reflection_start", frame.module());
  const auto empty = [&](const char* name, std::uint32_t size) {
    return start.write(tile_buffer(frame, name, size), gpu::Access::transfer_write);
  };
  tiles.commands = empty("reflection_commands", words);
  tiles.roughness = empty("reflection_tile_roughness", tiles.count);
  tiles.flags = empty("reflection_tile_flags", tiles.count);
  tiles.places = tile_buffer(frame, "reflection_tiles", std::uint64_t{GLOAM_TILE_LISTS} * tiles.lists.place_words);
  start.execute([commands = tiles.commands, roughness = tiles.roughness, flags = tiles.flags,
                 bytes = tiles.count * sizeof(std::uint32_t)](PassContext& context) {
    constexpr std::uint32_t kNoTile[] = {GLOAM_TILE_ROW, 0, 1, 0};
    for (std::uint32_t list = 0; list < GLOAM_TILE_LISTS; ++list)
      for (std::uint32_t i = 0; i < 4; ++i)
        context.commands().fill_buffer(context.buffer(commands), 4 * (list * kPartWords + i), 4, kNoTile[i]);
    context.commands().fill_buffer(context.buffer(roughness), 0, bytes, 0);
    context.commands().fill_buffer(context.buffer(flags), 0, bytes, 0);
  });
}

void list_tiles(FrameBuilder& frame, const ReflectionUniforms& uniforms, MirrorTiles& tiles, bool mirrors) {
  ComputePass pass(frame, mirrors ? "reflection_mirror_tiles" : "reflection_strong_tiles", list_tiles_program(mirrors));
  pass.read("reflection", uniforms.block);
  pass.read("tile_flags", tiles.flags);
  pass.push(tiles.lists);
  tiles.commands = pass.write("commands", tiles.commands);
  tiles.places = pass.write("places", tiles.places);
  pass.dispatch_over(uvec2(tiles.count, 1));
}

/// An image of the mirror surfaces. Without mirrored images shaders write none, and it has one texel.
ImageRef mirror_image(FrameBuilder& frame, const char* name, gpu::Format format, bool mirrors, std::uint32_t scale) {
  const std::uint32_t whole = std::max(frame.view().width, frame.view().height);
  return create_view_image(frame, name, format, mirrors ? scale : whole);
}

}  // namespace

ComputeProgram surface_program(bool mirrors, const gpu::SpecConstants& probes) {
  ComputeProgram program{shaders::reflections::surfaces_comp, {{"kMirrors", mirrors ? 1u : 0u}}};
  program.constants.set(probes);
  return program;
}

ComputeProgram list_tiles_program(bool mirrors) {
  return {shaders::reflections::list_tiles_comp, {{"kMirrors", mirrors ? 1u : 0u}}};
}

ComputeProgram surroundings_program(bool mirrors, const gpu::SpecConstants& probes) {
  ComputeProgram program{shaders::reflections::surroundings_comp, {{"kMirrors", mirrors ? 1u : 0u}}};
  program.constants.set(probes);
  return program;
}

MirrorSurfaces add_surface_passes(FrameBuilder& frame, const ReflectionUniforms& uniforms, bool mirrors) {
  MirrorSurfaces found;
  MirrorTiles& tiles = found.tiles;
  const uvec2 size = uniforms.constants.size;
  const uvec2 groups = (size + std::uint32_t{GLOAM_REFLECTION_GROUP} - 1u) / std::uint32_t{GLOAM_REFLECTION_GROUP};
  tiles.count = groups.x * groups.y;
  start_lists(frame, tiles);
  {
    ComputePass pass(frame, "reflection_surfaces",
                     surface_program(mirrors, probe_constants(frame.get<SurroundingProbes>())));
    pass.read("reflection", uniforms.block);
    read_geometry(pass, frame.get<GeometryOutputs>());
    read_surroundings(pass, frame);
    const std::uint32_t scale = uniforms.constants.scale;
    const ImageRef far = create_view_image(frame, "surroundings", gpu::Format::rgba16_float, scale);
    frame.put(SurroundingsOutput{pass.write("far_image", far)});
    found.surface = pass.write("surface_image",
                               mirror_image(frame, "reflection_surface", gpu::Format::rgba8_unorm, mirrors, scale));
    tiles.flags = pass.write("tile_flags", tiles.flags);
    pass.dispatch_over(size);
  }
  list_tiles(frame, uniforms, tiles, false);
  return found;
}

void add_surroundings_passes(FrameBuilder& frame, const ReflectionUniforms& uniforms, MirrorSurfaces& found,
                             bool mirrors) {
  MirrorTiles& tiles = found.tiles;
  {
    ComputePass pass(frame, "reflection_surroundings",
                     surroundings_program(mirrors, probe_constants(frame.get<SurroundingProbes>())));
    pass.read("reflection", uniforms.block);
    read_geometry(pass, frame.get<GeometryOutputs>());
    read_surroundings(pass, frame);
    LitOutput& lit = frame.get<LitOutput>();
    lit.color = pass.write("lit_image", lit.color);
    const ImageRef ambient = create_view_image(frame, "strong_ambient", gpu::Format::rgba16_float);
    frame.put(StrongAmbient{pass.write("ambient_image", ambient)});
    tiles.image = pass.write("mirror_image", mirror_image(frame, "reflection_mirrors", gpu::Format::rg32_uint, mirrors,
                                                          uniforms.constants.scale));
    tiles.roughness = pass.write("tile_roughness", tiles.roughness);
    tiles.flags = pass.write("tile_flags", tiles.flags);
    dispatch_listed_tiles(pass, tiles, GLOAM_LIST_STRONG);
  }
  if (mirrors) list_tiles(frame, uniforms, tiles, true);
  if (!mirrors) tiles.image = {};
}

void dispatch_mirror_tiles(ComputePass& pass, const MirrorTiles& tiles, std::uint32_t list) {
  if (pass.declares("mirror_image")) pass.read("mirror_image", tiles.image);
  dispatch_listed_tiles(pass, tiles, list);
}

void dispatch_listed_tiles(ComputePass& pass, const MirrorTiles& tiles, std::uint32_t list) {
  constexpr std::uint64_t kWord = sizeof(std::uint32_t);
  const std::uint64_t command = list * kWord * tiles.lists.command_words, bytes = kWord * tiles.lists.place_words;
  pass.read_part("mirror_commands", tiles.commands, command, sizeof(shaders::MirrorCommands));
  pass.read_part("mirror_tiles", tiles.places, list * bytes, bytes);
  pass.dispatch_indirect(tiles.commands, command);
}

}  // namespace gloam
