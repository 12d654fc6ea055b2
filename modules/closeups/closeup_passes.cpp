// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/closeup_passes.h"

#include <algorithm>

#include "engine/render/declare/compute_pass.h"
#include "engine/render/outputs.h"
#include "modules/closeups/compose/frame.h"
#include "modules/closeups/compose/overlay.h"
#include "modules/closeups/debug/unculled_pairs.h"
#include "modules/lights/outputs.h"
#include "shaders/closeups/closeups_shared.h"
#include "shaders/closeups/shaders.h"

namespace gloam {
namespace {

bool by_index(Entity a, Entity b) { return a.index < b.index; }

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

/// The pairs with faces of one size, that of the largest one, side by side in the close-up map.
std::vector<CloseupView> placed(std::span<const CloseupView> batch) {
  std::vector<CloseupView> pairs(batch.begin(), batch.end());
  std::uint32_t size = 0;
  for (const CloseupView& pair : pairs) size = std::max(size, pair.face.square.size);
  for (std::uint32_t i = 0; i < pairs.size(); ++i) pairs[i].face.square = {uvec2(i & 1u, i >> 1) * size, size};
  return pairs;
}

/// The pairs whose flag is set.
std::vector<CloseupView> chosen(std::span<const CloseupView> pairs, std::span<const std::uint8_t> flags) {
  std::vector<CloseupView> found;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    if (flags[i] != 0) found.push_back(pairs[i]);
  return found;
}

void draw_batch(FrameBuilder& frame, std::span<const CloseupView> pairs, MapMips mips, ExtraAtlas& map) {
  const auto& subjects = frame.world().resource<CloseupSubjects>();
  std::vector<ExtraMap> maps;
  for (const CloseupView& pair : pairs) maps.push_back({pair.face, subjects.subjects[pair.subject_index].casters});
  frame.get<ShadowMapDrawer>().draw(frame, "closeup", maps, map, mips);
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

/// `constants`: of each pair. `shadows`: with the filter for close-up maps and the atlas, pyramid and block of the
/// close-up map.
void compose_batch(FrameBuilder& frame, std::span<const CloseupView> pairs,
                   std::span<const shaders::CloseupConstants> constants, const ShadowsOutputs& shadows) {
  const gpu::DeviceInfo& device = frame.services().device.info();
  FinalLists& lists = *frame.get<ShadowsOutputs>().final_lists;
  ComputePass pass(frame, "closeup_compose", compose_program(shadows, pairs.front().directional, device));
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_shadows(pass, shadows);
  pass.read("light_texels", frame.get<LightsOutputs>().texels);
  pass.read("final_grid", lists.grid);
  write_final_lists(pass, lists);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const CloseupView& pair = pairs[i];
    if (i > 0) {
      pass.barrier();  // pairs may share tiles
      pass.use(compose_program(shadows, pair.directional, device));
    }
    pass.uniform("closeup", constants[i]);
    const uvec2 tiles = pair.tiles.end - pair.tiles.begin;
    pass.dispatch(tiles.x, tiles.y);
  }
}

}  // namespace

WithheldCasters withheld_casters(std::span<const CloseupView> pairs, const CloseupSubjects& subjects) {
  WithheldCasters withheld;
  for (const CloseupView& pair : pairs) {
    auto at = std::find_if(withheld.lights.begin(), withheld.lights.end(),
                           [&](const WithheldCasters::OfLight& of) { return of.light == pair.light; });
    if (at == withheld.lights.end()) at = withheld.lights.insert(at, {pair.light, {}});
    const std::vector<Entity>& casters = subjects.subjects[pair.subject_index].casters;
    at->casters.insert(at->casters.end(), casters.begin(), casters.end());
  }
  for (WithheldCasters::OfLight& of : withheld.lights) std::sort(of.casters.begin(), of.casters.end(), by_index);
  std::sort(withheld.lights.begin(), withheld.lights.end(),
            [](const auto& a, const auto& b) { return by_index(a.light, b.light); });
  return withheld;
}

bool closeup_pipelines_ready(const FrameBuilder& frame, const CloseupKnobs& knobs) {
  const auto* shadows = frame.find<ShadowsOutputs>();
  const auto* maps = frame.find<OverlayMaps>();
  if (shadows == nullptr || !shadows->final_lists || maps == nullptr) return false;
  const FrameServices& services = frame.services();
  const ShadowsOutputs looked = knobs.single_fetches ? by_single_fetches(*shadows) : *shadows;
  PipelineList list;
  for (const bool directional : {false, true})
    list.push_back(pipeline_desc(compose_program(looked, directional, services.device.info()), frame.module()));
  list_bounds_pipelines(maps->d16(), list);
  list_closeup_overlay_pipelines(maps->d16(), list);
  return services.pipelines.request(list, services.log);
}

void add_closeup_passes(FrameBuilder& frame, const CloseupKnobs& knobs) {
  auto* closeups = frame.find<CloseupFrame>();
  auto* shadows = frame.find<ShadowsOutputs>();
  auto* drawer = frame.find<ShadowMapDrawer>();
  if (closeups == nullptr || closeups->pairs.empty() || shadows == nullptr || drawer == nullptr) return;
  ExtraAtlas map = drawer->create(frame, frame.world().view_resource<CloseupSettings>(frame.view().id).map_size);
  CloseupOverlay overlay(knobs.draws_standard);
  UnculledPairs unculled(frame);
  overlay.start(frame, closeups->overlay);
  ShadowsOutputs looked = knobs.single_fetches ? by_single_fetches(*shadows) : *shadows;
  looked.block = drawer->block(frame, map.size);
  const std::vector<DirectionalLook> suns =
      directional_looks(frame.world().view_resource<VisibleLights>(frame.view().id));
  for (std::size_t first = 0; first < closeups->pairs.size(); first += knobs.batch) {
    const std::size_t count = std::min<std::size_t>(knobs.batch, closeups->pairs.size() - first);
    const std::vector<CloseupView> pairs = placed(std::span(closeups->pairs).subspan(first, count));
    const std::vector<CloseupView> copied = chosen(pairs, std::span(closeups->in_overlay).subspan(first, count));
    // The overlay reads coarser mips of the close-up map.
    const MapMips mips = knobs.single_fetches && copied.empty() ? MapMips::bounds_only : MapMips::all;
    draw_batch(frame, pairs, mips, map);
    looked.atlas = map.atlas;
    looked.pyramid = map.pyramid;
    std::vector<shaders::CloseupConstants> constants;
    for (const CloseupView& pair : pairs) constants.push_back(constants_of(pair, frame.view(), suns));
    compose_batch(frame, pairs, constants, looked);
    for (std::size_t i = 0; i < pairs.size(); ++i) unculled.add(frame, pairs[i], looked, constants[i]);
    overlay.add(frame, copied, map);
  }
  overlay.finish(frame);
  unculled.finish(frame);
}

}  // namespace gloam
