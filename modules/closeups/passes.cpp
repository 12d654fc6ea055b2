// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/passes.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "engine/render/outputs.h"
#include "modules/closeups/compose/frame.h"
#include "modules/closeups/compose/overlay.h"
#include "modules/lights/outputs.h"
#include "shaders/closeups/closeups_shared.h"
#include "shaders/closeups/shaders.h"

namespace gloam {
namespace {

constexpr const char* kModule = "closeups";
constexpr std::uint32_t kFirstShadowBinding = 12;

bool by_index(Entity a, Entity b) { return a.index < b.index; }

gpu::ComputePipelineDesc compose_pipeline(const ShadowsOutputs& shadows, bool directional,
                                          const gpu::DeviceInfo& device) {
  using namespace shaders::closeups;
  const FinalLists& lists = *shadows.final_lists;
  const gpu::ShaderCode code = directional ? (shadows.standard ? compose_suns_standard_comp : compose_suns_comp)
                                           : (shadows.standard ? compose_local_standard_comp : compose_local_comp);
  gpu::ComputePipelineDesc desc{
      std::string("closeup_compose/") + (directional ? "suns/" : "local/") + shadows.variant + "/" + lists.variant,
      kModule, code, shadows.constants};
  desc.constants.push_back({0, threads_a_tile(device)});
  desc.constants.insert(desc.constants.end(), lists.constants.begin(), lists.constants.end());
  return desc;
}

shaders::CloseupConstants constants_of(const CloseupView& pair, const RenderView& view, const DirectionalLook& sun) {
  shaders::CloseupConstants c{};
  c.near_m = pair.face.near_m;
  c.width_m = pair.width_m;
  c.tan_half = pair.face.tan_half;
  c.tan_inner = pair.tan_inner;
  c.right = pair.face.right;
  c.up = pair.face.up;
  c.size = static_cast<float>(pair.face.square.size);
  c.origin = vec2(pair.face.square.origin);
  c.first_tile = pair.tiles.begin;
  c.light = pair.light_index;
  if (!pair.directional) return c;
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

/// Pairs that share the close-up map at a time.
struct Batch {
  std::vector<CloseupView> pairs;
  std::vector<gpu::Binding::BufferRange> constants;
  std::vector<gpu::PipelineHandle> pipelines;
};

/// Gives all faces of a batch the size of the largest one, and places them side by side in the close-up map.
void place(std::vector<CloseupView>& pairs) {
  std::uint32_t size = 0;
  for (const CloseupView& pair : pairs) size = std::max(size, pair.face.square.size);
  for (std::uint32_t i = 0; i < pairs.size(); ++i) pairs[i].face.square = {uvec2(i & 1u, i >> 1) * size, size};
}

/// `shadows`: the outputs with the filter for close-up maps.
Result<Batch> make_batch(FrameBuilder& frame, std::span<const CloseupView> pairs, const ShadowsOutputs& shadows) {
  const FrameServices& services = frame.services();
  const std::vector<DirectionalLook> suns =
      directional_looks(frame.world().view_resource<VisibleLights>(frame.view().id));
  Batch batch;
  batch.pairs.assign(pairs.begin(), pairs.end());
  place(batch.pairs);
  for (const CloseupView& pair : batch.pairs) {
    const DirectionalLook sun =
        pair.directional && pair.light_index < suns.size() ? suns[pair.light_index] : DirectionalLook{};
    auto range = services.uniforms.write_value(constants_of(pair, frame.view(), sun));
    if (!range.ok()) return range.error();
    batch.constants.push_back(*range);
    auto pipeline = services.pipelines.get(compose_pipeline(shadows, pair.directional, services.device.info()));
    if (!pipeline.ok()) return pipeline.error();
    batch.pipelines.push_back(*pipeline);
  }
  return batch;
}

Status draw_batch(FrameBuilder& frame, const Batch& batch, const CloseupSubjects& subjects, ExtraAtlas& atlas) {
  std::vector<ExtraMap> maps;
  for (const CloseupView& pair : batch.pairs)
    maps.push_back({pair.face, subjects.subjects[pair.subject_index].casters});
  return frame.get<ShadowMapDrawer>().draw(frame, "closeup", kModule, maps, atlas);
}

/// Inputs for recording a compose pass.
struct Compose {
  Batch batch;
  ShadowsOutputs shadows;  ///< with the atlas, pyramid and block of the close-up map
  GeometryOutputs geometry;
  ImageRef texels;
  gpu::SamplerHandle sampler;
};

gpu::Binding::BufferRange whole(const PassContext& context, BufferRef buffer) { return {context.buffer(buffer)}; }

std::vector<gpu::Binding> bindings_of(const FrameBuilder& frame, const PassContext& context, const Compose& c,
                                      std::size_t pair) {
  const auto sampled = [&](ImageRef ref) { return gpu::Binding::Sampled{{.image = context.image(ref)}, c.sampler}; };
  const FinalLists& lists = *c.shadows.final_lists;
  std::vector<gpu::Binding> bindings = {frame.view_binding(),
                                        {1, c.batch.constants[pair]},
                                        {2, lists.grid},
                                        {3, sampled(c.geometry.depth)},
                                        {4, sampled(c.geometry.normals)},
                                        {5, sampled(c.geometry.base_color)},
                                        {6, sampled(c.texels)},
                                        {7, gpu::Binding::Storage{{.image = context.image(lists.tiles)}}},
                                        {8, whole(context, lists.entries)},
                                        {9, whole(context, lists.visibilities[0])},
                                        {10, whole(context, lists.visibilities[1])},
                                        {11, whole(context, lists.counters)}};
  append_shadow_bindings(bindings, kFirstShadowBinding, context, c.shadows);
  bindings.push_back({18, whole(context, lists.commands)});
  bindings.push_back({19, whole(context, lists.fallback_tiles)});
  bindings.push_back({20, sampled(c.geometry.depth_bounds)});
  return bindings;
}

void record(const FrameBuilder& frame, PassContext& context, const Compose& c) {
  const FinalLists& lists = *c.shadows.final_lists;
  std::vector<gpu::BufferBarrier> written;
  for (const BufferRef buffer :
       {lists.entries, lists.visibilities[0], lists.counters, lists.commands, lists.fallback_tiles})
    written.push_back({context.buffer(buffer), gpu::Access::compute_write, gpu::Access::compute_write});
  if (lists.visibilities[1].resource != lists.visibilities[0].resource)
    written.push_back({context.buffer(lists.visibilities[1]), gpu::Access::compute_write, gpu::Access::compute_write});
  const gpu::ImageBarrier tiles{context.image(lists.tiles), gpu::Access::compute_write, gpu::Access::compute_write};
  gpu::CommandList& commands = context.commands();
  for (std::size_t i = 0; i < c.batch.pairs.size(); ++i) {
    // Pairs may share tiles.
    if (i > 0) commands.barrier(written, {&tiles, 1});
    commands.bind_pipeline(c.batch.pipelines[i]);
    commands.bind(bindings_of(frame, context, c, i));
    const uvec2 count = c.batch.pairs[i].tiles.end - c.batch.pairs[i].tiles.begin;
    commands.dispatch(count.x, count.y, 1);
  }
}

void compose_batch(FrameBuilder& frame, Batch batch, const ExtraAtlas& atlas, gpu::Binding::BufferRange block,
                   ShadowsOutputs& shadows) {
  Compose c{std::move(batch), shadows, frame.get<GeometryOutputs>(), {}, shadows.nearest};
  const LightsOutputs& lights = frame.get<LightsOutputs>();
  c.texels = lights.texels ? lights.texels : c.geometry.base_color;
  c.shadows.block = block;
  c.shadows.atlas = atlas.atlas;
  c.shadows.pyramid = atlas.pyramid;
  PassBuilder pass = frame.graph().add_pass("closeup_compose", kModule);
  for (const ImageRef image :
       {c.geometry.depth, c.geometry.depth_bounds, c.geometry.normals, c.geometry.base_color, c.texels})
    pass.read(image, gpu::Access::compute_read);
  declare_shadow_reads(pass, c.shadows, gpu::Access::compute_read);
  FinalLists& lists = *shadows.final_lists;
  lists.tiles = pass.write(lists.tiles, gpu::Access::compute_write);
  const bool split = lists.visibilities[1].resource != lists.visibilities[0].resource;
  for (BufferRef* buffer :
       {&lists.entries, &lists.visibilities[0], &lists.counters, &lists.commands, &lists.fallback_tiles})
    *buffer = pass.write(*buffer, gpu::Access::compute_write);
  lists.visibilities[1] = split ? pass.write(lists.visibilities[1], gpu::Access::compute_write) : lists.visibilities[0];
  c.shadows.final_lists = lists;
  pass.execute([&frame, c = std::move(c)](PassContext& context) { record(frame, context, c); });
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
    list.push_back(compose_pipeline(looked, directional, services.device.info()));
  list_closeup_overlay_pipelines(maps->d16(), list);
  return services.pipelines.request(list, services.log);
}

Status add_closeup_passes(FrameBuilder& frame, const CloseupKnobs& knobs) {
  auto* closeups = frame.find<CloseupFrame>();
  auto* shadows = frame.find<ShadowsOutputs>();
  auto* drawer = frame.find<ShadowMapDrawer>();
  if (closeups == nullptr || closeups->pairs.empty() || shadows == nullptr || drawer == nullptr) return {};
  const auto& subjects = frame.world().resource<CloseupSubjects>();
  const CloseupSettings& settings = frame.world().view_resource<CloseupSettings>(frame.view().id);
  ExtraAtlas atlas = drawer->create(frame.graph(), kModule, settings.map_size);
  auto block = drawer->block(frame, atlas.size);
  if (!block.ok()) return block.error();
  const bool seen = standard_maps_are_seen(frame, shadows->final_lists->always_complete);
  if (seen && !closeups->copies) add_late_copies(frame, *closeups);
  CloseupOverlay overlay(knobs.draws_standard);
  if (seen) GLOAM_TRY(overlay.start(frame, closeups->overlay));
  const std::span<const CloseupView> pairs = closeups->pairs;
  const ShadowsOutputs looked = knobs.single_fetches ? by_single_fetches(*shadows) : *shadows;
  for (std::size_t first = 0; first < pairs.size(); first += knobs.batch) {
    const std::size_t count = std::min<std::size_t>(knobs.batch, pairs.size() - first);
    auto batch = make_batch(frame, pairs.subspan(first, count), looked);
    if (!batch.ok()) return batch.error();
    GLOAM_TRY(draw_batch(frame, *batch, subjects, atlas));
    const std::vector<CloseupView> placed = batch->pairs;
    compose_batch(frame, std::move(*batch), atlas, *block, *shadows);
    GLOAM_TRY(overlay.add(frame, placed, atlas));
  }
  return overlay.finish(frame);
}

}  // namespace gloam
