// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/compose/composition.h"

#include <algorithm>

#include "engine/core/hash.h"
#include "engine/render/declare/compute_pass.h"
#include "engine/render/outputs.h"
#include "shaders/closeups/shaders.h"

namespace gloam {
namespace {

ComputeProgram compose_program(const ShadowsOutputs& shadows, bool directional, const gpu::DeviceInfo& device) {
  using namespace shaders::closeups;
  ComputeProgram program{directional ? (shadows.standard ? compose_suns_standard_comp : compose_suns_comp)
                                     : (shadows.standard ? compose_local_standard_comp : compose_local_comp),
                         shadows.constants};
  program.constants.set("local_size_x", threads_a_tile(device));
  program.constants.set_if_present("kThinFilter", 0u);  // close-up maps may lack the coarse mips that it reads
  program.constants.set(shadows.final_lists->constants);
  return program;
}

ComputeProgram tiles_program(const ShadowsOutputs& shadows, bool directional) {
  return {directional ? shaders::closeups::tiles_suns_comp : shaders::closeups::tiles_local_comp, shadows.constants};
}

void write_final_lists(ComputePass& pass, FinalLists& lists) {
  lists.tiles = pass.write("final_tiles", lists.tiles);
  lists.entries = pass.write("entries", lists.entries);
  write_visibilities(pass, lists);
  lists.counters = pass.write("counters", lists.counters);
  lists.commands = pass.write("commands", lists.commands);
  lists.fallback_tiles = pass.write("fallback_tiles", lists.fallback_tiles);
  lists.kept_tiles = pass.write("kept_tiles", lists.kept_tiles);
}

/// Pairs whose tiles are listed together: at most this many, with at most as many tiles as this many views have. A
/// view's pairs seldom need more, and with many pairs the lists stay small.
constexpr std::size_t kMostPairsAtATime = 64;
constexpr std::uint32_t kListedViews = 4;

/// The listed tiles of pairs, and one indirect command for each pair.
struct PairTiles {
  BufferRef commands;
  BufferRef items;
};

BufferRef create(FrameBuilder& frame, const char* name, std::uint64_t bytes) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = frame.module();
  desc.size = std::max<std::uint64_t>(bytes, 4);
  return frame.graph().create_buffer(desc);
}

/// Lists of the tiles of some pairs: both buffers are as large for any number of pairs.
PairTiles create_tile_lists(FrameBuilder& frame, std::uint64_t items) {
  return {create(frame, "closeup_commands", kMostPairsAtATime * sizeof(uvec4)),
          create(frame, "closeup_tiles", items * sizeof(uvec2))};
}

void add_tile_lists(FrameBuilder& frame, std::span<const CloseupView> pairs,
                    std::span<const shaders::CloseupConstants> constants, const ShadowsOutputs& shadows,
                    PairTiles& tiles) {
  PassBuilder start = frame.graph().add_pass("closeup_tiles_start", frame.module());
  tiles.commands = start.write(tiles.commands, gpu::Access::transfer_write);
  start.execute([commands = tiles.commands, bytes = pairs.size() * sizeof(uvec4)](PassContext& context) {
    context.commands().fill_buffer(context.buffer(commands), 0, bytes, 0);
  });
  const FinalLists& lists = *frame.get<ShadowsOutputs>().final_lists;
  ComputePass pass(frame, "closeup_tiles", tiles_program(shadows, pairs.front().directional));
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_shadows(pass, shadows);
  pass.read("final_grid", lists.grid);
  pass.read("final_tiles", lists.tiles);
  pass.read("entries", lists.entries);
  pass.read("kept_tiles", lists.has_anew ? lists.kept_tiles : lists.entries);  // not read without has_anew
  tiles.commands = pass.write("pair_commands", tiles.commands);
  tiles.items = pass.write("pair_tiles", tiles.items);
  pass.push(lists.has_anew ? 1u : 0u);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    pass.use(tiles_program(shadows, pairs[i].directional));
    pass.read_if_declared("light_texels", frame.get<LightsOutputs>().texels);
    pass.uniform("closeup", constants[i]);
    pass.dispatch_over(pairs[i].tiles.end - pairs[i].tiles.begin);
  }
}

/// Lowers visibilities in the listed tiles.
void add_compose_pass(FrameBuilder& frame, std::span<const CloseupView> pairs,
                      std::span<const shaders::CloseupConstants> constants, const ShadowsOutputs& shadows,
                      const PairTiles& tiles) {
  const gpu::DeviceInfo& device = frame.services().device.info();
  FinalLists& lists = *frame.get<ShadowsOutputs>().final_lists;
  ComputePass pass(frame, "closeup_compose", compose_program(shadows, pairs.front().directional, device));
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_shadows(pass, shadows);
  pass.read("light_texels", frame.get<LightsOutputs>().texels);
  pass.read("final_grid", lists.grid);
  pass.read("pair_commands", tiles.commands);
  pass.read("pair_tiles", tiles.items);
  write_final_lists(pass, lists);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    if (i > 0) {
      pass.barrier();  // pairs may share tiles
      pass.use(compose_program(shadows, pairs[i].directional, device));
    }
    pass.uniform("closeup", constants[i]);
    pass.dispatch_indirect(tiles.commands, i * sizeof(uvec4));
  }
}

/// What the content of a pair's map, and the look at it, depend on besides casters, view and light.
std::uint64_t hash_of(const CloseupView& pair) {
  const ShadowFace& face = pair.face;
  Hasher hasher;
  hasher.value(pair.subject.index).value(pair.subject.generation).value(face.square.size);
  for (const dvec3& v : {face.origin, dvec3(face.right), dvec3(face.up), dvec3(face.forward)}) hasher.bytes_of(v);
  for (const float value : {face.tan_half, face.half_extent_m, face.near_m, face.clip_share, face.far_m, pair.tan_inner,
                            pair.emitter_diameter_m, pair.penumbra_m_per_m})
    hasher.bytes_of(value);
  hasher.bytes_of(pair.tiles.begin).bytes_of(pair.tiles.end);
  return hasher.digest();
}

}  // namespace

shaders::CloseupConstants constants_of(const CloseupView& pair, const RenderView& view,
                                       std::span<const DirectionalLook> suns) {
  shaders::CloseupConstants c{};
  c.near_m = pair.face.near_m;
  c.emitter_diameter_m = pair.emitter_diameter_m;
  c.tan_half = pair.face.tan_half;
  c.tan_inner = pair.tan_inner;
  c.right = pair.face.right;
  c.up = pair.face.up;
  c.size = static_cast<float>(pair.face.square.size);
  c.origin = vec2(pair.face.square.origin);
  c.first_tile = pair.tiles.begin;
  c.end_tile = pair.tiles.end;
  c.light = pair.light_index;
  if (!pair.directional) return c;
  const DirectionalLook sun = pair.light_index < suns.size() ? suns[pair.light_index] : DirectionalLook{};
  const shaders::ShadowCascade cascade = orthographic_constants(pair.face, view.position);
  c.penumbra_m_per_m = pair.penumbra_m_per_m;
  c.row_u = cascade.row_u;
  c.row_v = cascade.row_v;
  c.row_depth = cascade.row_depth;
  c.texel_m = cascade.texel_m;
  c.depth_m = cascade.depth_m;
  c.direction = sun.direction;
  c.brightest = sun.brightest;
  return c;
}

ComposedLights composed_lights(std::span<const CloseupView> pairs, const CloseupKnobs& knobs) {
  ComposedLights composed;
  for (const CloseupView& pair : pairs) {
    auto at = std::ranges::find(composed.lights, pair.light, &ComposedLights::OfLight::light);
    if (at == composed.lights.end())
      at = composed.lights.insert(at, {pair.light, knobs.batch * 2 + (knobs.single_fetches ? 1u : 0u)});
    at->hash = Hasher().value(at->hash).value(hash_of(pair)).digest();
  }
  return composed;
}

void add_composition(FrameBuilder& frame, std::span<const CloseupView> pairs,
                     std::span<const shaders::CloseupConstants> constants, const ShadowsOutputs& shadows) {
  const gpu::ImageDesc& view_tiles = frame.graph().desc(frame.get<ShadowsOutputs>().final_lists->tiles);
  const std::uint64_t room = std::uint64_t{kListedViews} * view_tiles.width * view_tiles.height;
  PairTiles tiles = create_tile_lists(frame, room);
  for (std::size_t first = 0; first < pairs.size();) {
    std::vector<shaders::CloseupConstants> together;
    std::uint64_t items = 0;
    for (std::size_t i = first; i < pairs.size() && together.size() < kMostPairsAtATime; ++i) {
      if (items + pairs[i].tiles.tiles() > room) break;
      together.push_back(constants[i]);
      together.back().pair = static_cast<std::uint32_t>(together.size() - 1);
      together.back().first_item = static_cast<std::uint32_t>(items);
      items += pairs[i].tiles.tiles();
    }
    const std::span<const CloseupView> some = pairs.subspan(first, together.size());
    add_tile_lists(frame, some, together, shadows, tiles);
    add_compose_pass(frame, some, together, shadows, tiles);
    first += together.size();
  }
}

void list_composition_pipelines(const ShadowsOutputs& shadows, const gpu::DeviceInfo& device, PipelineList& list) {
  for (const bool directional : {false, true}) {
    list.push_back(pipeline_desc(compose_program(shadows, directional, device), "closeups"));
    list.push_back(pipeline_desc(tiles_program(shadows, directional), "closeups"));
  }
}

}  // namespace gloam
