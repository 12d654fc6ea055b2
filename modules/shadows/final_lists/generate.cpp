// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/final_lists/generate.h"

#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "modules/lights/outputs.h"
#include "modules/shadows/final_lists/buffers.h"
#include "modules/shadows/maps/planes.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

constexpr std::uint32_t kFirstShadowBinding = 12;
constexpr std::uint32_t kTilesAGroup = 8;  // tiles along a side of a workgroup

gpu::ComputePipelineDesc classify_pipeline(const ShadowsOutputs& shadows) {
  return {"classify_shadows/" + shadows.variant, "shadows", shaders::shadows::classify_comp, shadows.constants};
}

constexpr const char* kPairKinds[GLOAM_PAIR_KINDS] = {"in_face", "crossing", "suns"};

gpu::ShaderCode generate_code(std::uint32_t kind, bool standard) {
  using namespace shaders::shadows;
  if (kind == GLOAM_PAIRS_DIRECTIONAL) return standard ? generate_suns_standard_comp : generate_suns_comp;
  if (kind == GLOAM_PAIRS_CROSSING) return standard ? generate_crossing_standard_comp : generate_crossing_comp;
  return standard ? generate_in_face_standard_comp : generate_in_face_comp;
}

gpu::ComputePipelineDesc generate_pipeline(const ShadowsOutputs& shadows, std::uint32_t visibility_bits,
                                           std::uint32_t kind, const gpu::DeviceInfo& device) {
  gpu::ComputePipelineDesc desc{std::string("generate_shadows/") + kPairKinds[kind] + "/" + shadows.variant + "/" +
                                    std::to_string(visibility_bits),
                                "shadows", generate_code(kind, shadows.standard), shadows.constants};
  desc.constants.push_back({0, threads_a_tile(device)});
  desc.constants.push_back({GLOAM_FINAL_BITS_ID, visibility_bits});
  return desc;
}

/// Whether the view has lights that can form pairs of this kind.
bool has_pairs(const LightsOutputs& lights, std::uint32_t kind) {
  return (kind == GLOAM_PAIRS_DIRECTIONAL ? lights.directional_count : lights.local_count) > 0;
}

gpu::ComputePipelineDesc finish_pipeline() { return {"finish_lists", "shadows", shaders::shadows::finish_comp, {}}; }

/// The inputs of all passes.
struct Generate {
  FinalListBuffers buffers;
  LightsOutputs lights;
  GeometryOutputs geometry;
  ImageRef texels;      ///< of local lights; without any, another image
  ImageRef tile_lists;  ///< early lists; without any, another image
  ImageRef planes;      ///< without classification, another image
  gpu::SamplerHandle sampler;
  ShadowsOutputs shadows;
  uvec2 tiles;
  [[nodiscard]] FinalLists& lists() { return buffers.lists; }
};

gpu::Binding::BufferRange whole(const PassContext& context, BufferRef buffer) { return {context.buffer(buffer)}; }

void add_start_pass(FrameBuilder& frame, Generate& g) {
  PassBuilder pass = frame.graph().add_pass("shadow_list_start", "shadows");
  g.lists().commands = pass.write(g.lists().commands, gpu::Access::transfer_write);
  g.lists().counters = pass.write(g.lists().counters, gpu::Access::transfer_write);
  pass.execute([commands_ref = g.lists().commands, counters = g.lists().counters](PassContext& context) {
    constexpr std::uint64_t kWord = sizeof(std::uint32_t);
    constexpr std::uint32_t kStart[] = {
        GLOAM_PAIRS_ROW, 0, 1, 0, GLOAM_PAIRS_ROW, 0, 1, 0, GLOAM_PAIRS_ROW, 0, 1, 0, 6, 0, 0, 0};
    static_assert(sizeof(kStart) == sizeof(shaders::ShadowListCommands));
    gpu::CommandList& commands = context.commands();
    commands.fill_buffer(context.buffer(counters), 0, sizeof(shaders::ShadowListCounters), 0);
    for (std::size_t i = 0; i < std::size(kStart); ++i)
      commands.fill_buffer(context.buffer(commands_ref), i * kWord, kWord, kStart[i]);
  });
}

Status add_classify_pass(FrameBuilder& frame, Generate& g) {
  auto pipeline = frame.services().pipelines.get(classify_pipeline(g.shadows));
  if (!pipeline.ok()) return pipeline.error();
  FinalLists& lists = g.lists();
  PassBuilder pass = frame.graph().add_pass("classify_shadows", "shadows");
  for (const ImageRef image : {g.geometry.depth_bounds, g.geometry.depth, g.geometry.normals, g.geometry.base_color,
                               g.tile_lists, g.texels, g.planes})
    pass.read(image, gpu::Access::compute_read);
  if (g.lights.has_lists()) pass.read(g.lights.early_lists, gpu::Access::compute_read);
  declare_shadow_reads(pass, g.shadows, gpu::Access::compute_read);
  lists.tiles = pass.write(lists.tiles, gpu::Access::compute_write);
  for (BufferRef* buffer : {&lists.entries, &g.buffers.pairs, &lists.counters, &lists.commands})
    *buffer = pass.write(*buffer, gpu::Access::compute_write);
  pass.execute([&frame, g, pipeline = *pipeline](PassContext& context) mutable {
    const auto sampled = [&](ImageRef ref) { return gpu::Binding::Sampled{{.image = context.image(ref)}, g.sampler}; };
    const FinalLists& l = g.lists();
    const BufferRef early = g.lights.has_lists() ? g.lights.early_lists : l.entries;
    std::vector<gpu::Binding> bindings = {frame.view_binding(),
                                          {2, g.buffers.grid},
                                          {3, sampled(g.geometry.depth_bounds)},
                                          {4, sampled(g.tile_lists)},
                                          {5, whole(context, early)},
                                          {6, sampled(g.texels)},
                                          {7, gpu::Binding::Storage{{.image = context.image(l.tiles)}}},
                                          {8, whole(context, l.entries)},
                                          {9, whole(context, g.buffers.pairs)},
                                          {10, whole(context, l.counters)},
                                          {11, whole(context, l.commands)}};
    append_shadow_bindings(bindings, kFirstShadowBinding, context, g.shadows);
    bindings.push_back({18, sampled(g.planes)});
    bindings.push_back({19, sampled(g.geometry.depth)});
    bindings.push_back({20, sampled(g.geometry.normals)});
    bindings.push_back({21, sampled(g.geometry.base_color)});
    gpu::CommandList& commands = context.commands();
    commands.bind_pipeline(pipeline);
    commands.bind(bindings);
    commands.dispatch((g.tiles.x + kTilesAGroup - 1) / kTilesAGroup, (g.tiles.y + kTilesAGroup - 1) / kTilesAGroup, 1);
  });
  return {};
}

/// By kind of pair; null when the view has no lights of the kind.
using PairPipelines = std::array<gpu::PipelineHandle, GLOAM_PAIR_KINDS>;

Result<PairPipelines> pair_pipelines(FrameBuilder& frame, Generate& g) {
  PairPipelines made;
  const FrameServices& services = frame.services();
  for (std::uint32_t kind = 0; kind < GLOAM_PAIR_KINDS; ++kind) {
    if (!has_pairs(g.lights, kind)) continue;
    auto found =
        services.pipelines.get(generate_pipeline(g.shadows, g.lists().visibility_bits, kind, services.device.info()));
    if (!found.ok()) return found.error();
    made[kind] = *found;
  }
  return made;
}

std::vector<gpu::Binding> pair_bindings(const FrameBuilder& frame, const PassContext& context, Generate& g) {
  const auto sampled = [&](ImageRef ref) { return gpu::Binding::Sampled{{.image = context.image(ref)}, g.sampler}; };
  const FinalLists& l = g.lists();
  std::vector<gpu::Binding> bindings = {frame.view_binding(),
                                        {2, g.buffers.grid},
                                        {3, sampled(g.geometry.depth)},
                                        {4, sampled(g.geometry.normals)},
                                        {5, sampled(g.geometry.base_color)},
                                        {6, sampled(g.texels)},
                                        {7, whole(context, g.buffers.pairs)},
                                        {8, whole(context, l.entries)},
                                        {9, whole(context, l.visibilities[0])},
                                        {10, whole(context, l.visibilities[1])},
                                        {11, whole(context, l.counters)}};
  append_shadow_bindings(bindings, kFirstShadowBinding, context, g.shadows);
  bindings.push_back({18, whole(context, l.commands)});
  return bindings;
}

void record_pairs(const FrameBuilder& frame, PassContext& context, Generate& g, const PairPipelines& pipelines) {
  const FinalLists& l = g.lists();
  const gpu::BufferHandle arguments = context.buffer(l.commands);
  const std::vector<gpu::Binding> bindings = pair_bindings(frame, context, g);
  // Pairs of different kinds write to different places of the same buffers.
  std::vector<gpu::BufferBarrier> written;
  for (const BufferRef buffer : {l.entries, l.visibilities[0], l.counters})
    written.push_back({context.buffer(buffer), gpu::Access::compute_write, gpu::Access::compute_write});
  if (l.visibilities[1].resource != l.visibilities[0].resource)
    written.push_back({context.buffer(l.visibilities[1]), gpu::Access::compute_write, gpu::Access::compute_write});
  gpu::CommandList& commands = context.commands();
  bool first = true;
  for (std::uint32_t kind = 0; kind < GLOAM_PAIR_KINDS; ++kind) {
    if (!pipelines[kind]) continue;
    if (!first) commands.barrier(written, {});
    first = false;
    commands.bind_pipeline(pipelines[kind]);
    commands.bind(bindings);
    commands.dispatch_indirect(arguments, offsetof(shaders::ShadowListCommands, pairs) + kind * sizeof(uvec4));
  }
}

Status add_pairs_pass(FrameBuilder& frame, Generate& g) {
  auto pipelines = pair_pipelines(frame, g);
  if (!pipelines.ok()) return pipelines.error();
  FinalLists& lists = g.lists();
  PassBuilder pass = frame.graph().add_pass("generate_shadows", "shadows");
  for (const ImageRef image : {g.geometry.depth, g.geometry.normals, g.geometry.base_color, g.texels})
    pass.read(image, gpu::Access::compute_read);
  pass.read(g.buffers.pairs, gpu::Access::compute_read);
  pass.read(lists.commands, gpu::Access::indirect_read);
  pass.read(lists.commands, gpu::Access::compute_read);
  declare_shadow_reads(pass, g.shadows, gpu::Access::compute_read);
  const bool split = lists.visibilities[1].resource != lists.visibilities[0].resource;
  for (BufferRef* buffer : {&lists.entries, &lists.visibilities[0], &lists.counters})
    *buffer = pass.write(*buffer, gpu::Access::compute_write);
  lists.visibilities[1] = split ? pass.write(lists.visibilities[1], gpu::Access::compute_write) : lists.visibilities[0];
  pass.execute([&frame, g, pipelines = *pipelines](PassContext& context) mutable {
    record_pairs(frame, context, g, pipelines);
  });
  return {};
}

Status add_finish_pass(FrameBuilder& frame, Generate& g) {
  auto pipeline = frame.services().pipelines.get(finish_pipeline());
  if (!pipeline.ok()) return pipeline.error();
  FinalLists& lists = g.lists();
  PassBuilder pass = frame.graph().add_pass("finish_lists", "shadows");
  lists.tiles = pass.write(lists.tiles, gpu::Access::compute_write);
  for (BufferRef* buffer : {&lists.entries, &lists.fallback_tiles, &lists.counters, &lists.commands})
    *buffer = pass.write(*buffer, gpu::Access::compute_write);
  pass.execute([g, pipeline = *pipeline](PassContext& context) mutable {
    const FinalLists& l = g.lists();
    gpu::CommandList& commands = context.commands();
    commands.bind_pipeline(pipeline);
    const gpu::Binding bindings[] = {{0, g.buffers.grid},
                                     {1, gpu::Binding::Storage{{.image = context.image(l.tiles)}}},
                                     {2, whole(context, l.entries)},
                                     {3, whole(context, l.fallback_tiles)},
                                     {4, whole(context, l.counters)},
                                     {5, whole(context, l.commands)}};
    commands.bind(bindings);
    commands.dispatch((g.tiles.x + kTilesAGroup - 1) / kTilesAGroup, (g.tiles.y + kTilesAGroup - 1) / kTilesAGroup, 1);
  });
  return {};
}

}  // namespace

bool can_generate(const FrameBuilder& frame, const ShadowKnobs& knobs) {
  const LightsOutputs* lights = frame.find<LightsOutputs>();
  return knobs.deferred && knobs.levels != 0 && lights != nullptr && (lights->local_count == 0 || lights->has_lists());
}

bool generate_pipelines_ready(const FrameBuilder& frame, const ShadowKnobs& knobs, const ShadowsOutputs& shadows) {
  const FrameServices& services = frame.services();
  if (services.wait_for_pipelines) return true;
  const LightsOutputs& lights = *frame.find<LightsOutputs>();
  PipelineList list = {classify_pipeline(shadows), finish_pipeline()};
  for (std::uint32_t kind = 0; kind < GLOAM_PAIR_KINDS; ++kind)
    if (has_pairs(lights, kind))
      list.push_back(generate_pipeline(shadows, visibility_bits_of(knobs), kind, services.device.info()));
  if (knobs.classify) list_shadow_plane_pipelines(list);
  return services.pipelines.request(list, services.log);
}

Status add_generate_passes(FrameBuilder& frame, const ShadowKnobs& knobs, ImageRef planes, ShadowsOutputs& shadows) {
  Generate g;
  auto buffers = make_final_list_buffers(frame, knobs);
  if (!buffers.ok()) return buffers.error();
  g.buffers = std::move(*buffers);
  g.lights = frame.get<LightsOutputs>();
  g.geometry = frame.get<GeometryOutputs>();
  g.texels = g.lights.texels ? g.lights.texels : g.geometry.base_color;
  g.tile_lists = g.lights.has_lists() ? g.lights.tile_lists : g.geometry.normals;
  g.shadows = shadows;
  g.planes = planes ? planes : shadows.rows;
  g.sampler = shadows.nearest;
  const gpu::ImageDesc& tiles = frame.graph().desc(g.lists().tiles);
  g.tiles = {tiles.width, tiles.height};
  add_start_pass(frame, g);
  GLOAM_TRY(add_classify_pass(frame, g));
  GLOAM_TRY(add_pairs_pass(frame, g));
  GLOAM_TRY(add_finish_pass(frame, g));
  frame.put(g.buffers.note);
  shadows.final_lists = std::move(g.lists());
  return {};
}

}  // namespace gloam
