// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/final_lists/generate.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "engine/render/declare/compute_pass.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/final_lists/buffers.h"
#include "modules/shadows/maps/planes.h"
#include "shaders/shadows/final_lists/reproject_shared.h"
#include "shaders/shadows/shaders.h"

namespace gloam {
namespace {

/// reuse: what the frame keeps of the last one.
ComputeProgram list_program(const ShadowsOutputs& shadows, std::uint32_t visibility_bits, ShadowReuse reuse) {
  using namespace shaders::shadows;
  if (reuse == ShadowReuse::off) return {list_tile_lights_comp, shadows.constants};
  ComputeProgram program{reuse == ShadowReuse::exact ? list_tile_lights_kept_comp : list_tile_lights_reprojected_comp,
                         shadows.constants};
  program.constants.set("kVisibilityBits", visibility_bits);
  return program;
}

ComputeProgram sources_program() { return {shaders::shadows::find_sources_comp}; }

ComputeProgram finish_program(bool reuse) {
  return {reuse ? shaders::shadows::finish_kept_comp : shaders::shadows::finish_comp};
}

ComputeProgram classify_program(const ShadowsOutputs& shadows, bool directional) {
  return {directional ? shaders::shadows::classify_suns_comp : shaders::shadows::classify_local_comp,
          shadows.constants};
}

bool has_lights(const LightsOutputs& lights, bool directional) {
  return (directional ? lights.directional_count : lights.local_count) > 0;
}

gpu::ShaderCode generate_code(std::uint32_t kind, bool standard) {
  using namespace shaders::shadows;
  if (kind == GLOAM_PAIRS_DIRECTIONAL) return standard ? generate_suns_standard_comp : generate_suns_comp;
  if (kind == GLOAM_PAIRS_CROSSING) return standard ? generate_crossing_standard_comp : generate_crossing_comp;
  return standard ? generate_in_face_standard_comp : generate_in_face_comp;
}

ComputeProgram generate_program(const ShadowsOutputs& shadows, std::uint32_t visibility_bits, std::uint32_t kind,
                                const gpu::DeviceInfo& device) {
  ComputeProgram program{generate_code(kind, shadows.standard), shadows.constants};
  program.constants.set("local_size_x", threads_a_tile(device));
  if (kind == GLOAM_PAIRS_IN_FACE) program.constants.set("kNear", 0u);  // classification leaves none that needs it
  program.constants.set("kVisibilityBits", visibility_bits);
  return program;
}

/// The kinds of pairs that the view's lights can form.
std::vector<std::uint32_t> kinds_of(const LightsOutputs& lights) {
  std::vector<std::uint32_t> kinds;
  for (std::uint32_t kind = 0; kind < GLOAM_PAIR_KINDS; ++kind)
    if (has_lights(lights, kind == GLOAM_PAIRS_DIRECTIONAL)) kinds.push_back(kind);
  return kinds;
}

/// Sets a buffer of commands word by word.
template <std::size_t kWords>
void fill_commands(PassContext& context, BufferRef buffer, const std::uint32_t (&words)[kWords]) {
  constexpr std::uint64_t kWord = sizeof(std::uint32_t);
  for (std::size_t i = 0; i < kWords; ++i)
    context.commands().fill_buffer(context.buffer(buffer), i * kWord, kWord, words[i]);
}

void add_start_pass(FrameBuilder& frame, FinalListBuffers& buffers) {
  FinalLists& lists = buffers.lists;
  PassBuilder pass = frame.graph().add_pass("shadow_list_start", frame.module());
  lists.commands = pass.write(lists.commands, gpu::Access::transfer_write);
  buffers.candidate_commands = pass.write(buffers.candidate_commands, gpu::Access::transfer_write);
  lists.counters = pass.write(lists.counters, gpu::Access::transfer_write);
  pass.execute([commands = lists.commands, candidates = buffers.candidate_commands,
                counters = lists.counters](PassContext& context) {
    constexpr std::uint32_t kPairs[] = {
        GLOAM_PAIRS_ROW, 0, 1, 0, GLOAM_PAIRS_ROW, 0, 1, 0, GLOAM_PAIRS_ROW, 0, 1, 0, 6, 0, 0, 0};
    constexpr std::uint32_t kCandidates[] = {0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0};
    static_assert(sizeof(kPairs) == sizeof(shaders::ShadowListCommands) &&
                  sizeof(kCandidates) == sizeof(shaders::ShadowCandidateCommands));
    context.commands().fill_buffer(context.buffer(counters), 0, sizeof(shaders::ShadowListCounters), 0);
    fill_commands(context, commands, kPairs);
    fill_commands(context, candidates, kCandidates);
  });
}

/// What the frame keeps of the last one.
struct Kept {
  ShadowReuse reuse = ShadowReuse::off;     ///< off: tiles get no keys, and the other members are empty
  KeptBuffers last;                         ///< of the last frame
  std::vector<std::uint32_t> last_indices;  ///< last_indices()
  // With ShadowReuse::reprojected:
  shaders::ReprojectBlock reproject{};
  HistoryBuffer last_pixels, pixels;  ///< of the last frame and of this one
  BufferRef sources;                  ///< of find_sources.comp.glsl
  std::uint32_t exact_frames = 4;     ///< ViewReuse::exact_frames
};

/// Binds what list_tile_lights_kept.comp.glsl and list_tile_lights_reprojected.comp.glsl have more than
/// list_tile_lights.comp.glsl.
void bind_kept(ComputePass& pass, const Kept& kept, FinalListBuffers& buffers) {
  pass.read("last_tiles", kept.last.tiles);
  pass.read("last_entries", kept.last.entries);
  pass.read("last_visibilities_0", kept.last.visibilities[0]);
  pass.read("last_visibilities_1", kept.last.visibilities[1]);
  pass.items<std::uint32_t>("last_indices", kept.last_indices);
  pass.items<std::uint32_t>("reserved_tiles", buffers.reserved_tiles);
  buffers.lists.kept_tiles = pass.write("kept_tiles", buffers.lists.kept_tiles);
  write_visibilities(pass, buffers.lists);
  if (kept.reuse != ShadowReuse::reprojected) return;
  pass.items<shaders::ReprojectBlock>("reproject", std::span(&kept.reproject, 1));
  pass.read("sources", kept.sources);
}

/// Finds for each pixel where the last frame saw its surface.
void add_sources_pass(FrameBuilder& frame, Kept& kept) {
  ComputePass pass(frame, "find_shadow_sources", sources_program());
  read_geometry(pass, frame.get<GeometryOutputs>());
  pass.items<shaders::ReprojectBlock>("reproject", std::span(&kept.reproject, 1));
  pass.read("last_pixels", kept.last_pixels.buffer);
  static_cast<void>(pass.write("kept_pixels", kept.pixels.buffer));  // the next frame reads it
  gpu::BufferDesc desc;
  desc.name = "shadow_sources";
  desc.module = "shadows";
  desc.size = frame.graph().desc(kept.pixels.buffer).size / 2;
  kept.sources = pass.write("sources", frame.graph().create_buffer(desc));
  pass.dispatch_over(frame.view().width, frame.view().height);
}

void add_list_pass(FrameBuilder& frame, const ShadowsOutputs& shadows, const Kept& kept, FinalListBuffers& buffers) {
  FinalLists& lists = buffers.lists;
  ComputePass pass(frame, "list_tile_lights", list_program(shadows, lists.visibility_bits, kept.reuse));
  if (kept.reuse != ShadowReuse::off) bind_kept(pass, kept, buffers);
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_light_lists(pass, frame.get<LightsOutputs>());
  read_shadows(pass, shadows);
  pass.read("final_grid", lists.grid);
  lists.tiles = pass.write("final_tiles", lists.tiles);
  lists.entries = pass.write("entries", lists.entries);
  buffers.pairs = pass.write("pairs", buffers.pairs);
  buffers.candidates = pass.write("candidates", buffers.candidates);
  buffers.candidate_commands = pass.write("candidate_commands", buffers.candidate_commands);
  buffers.tile_groups = pass.write("tile_groups", buffers.tile_groups);
  lists.counters = pass.write("counters", lists.counters);
  lists.commands = pass.write("commands", lists.commands);
  const gpu::ImageDesc& tiles = frame.graph().desc(lists.tiles);
  pass.dispatch_over(tiles.width, tiles.height);
}

void add_classify_pass(FrameBuilder& frame, const ShadowsOutputs& shadows, ImageRef planes, FinalListBuffers& buffers) {
  FinalLists& lists = buffers.lists;
  const LightsOutputs& lights = frame.get<LightsOutputs>();
  ComputePass pass(frame, "classify_shadows", classify_program(shadows, !has_lights(lights, false)));
  read_light_lists(pass, lights);
  read_shadows(pass, shadows);
  pass.read("shadow_planes", planes);
  pass.read("final_grid", lists.grid);
  pass.read("candidates", buffers.candidates);
  pass.read("candidate_commands", buffers.candidate_commands);
  pass.read("tile_groups", buffers.tile_groups);
  lists.entries = pass.write("entries", lists.entries);
  buffers.pairs = pass.write("pairs", buffers.pairs);
  lists.counters = pass.write("counters", lists.counters);
  lists.commands = pass.write("commands", lists.commands);
  bool first = true;
  for (std::uint32_t kind = 0; kind < GLOAM_CANDIDATE_KINDS; ++kind) {
    const bool directional = (kind & GLOAM_CANDIDATES_DIRECTIONAL) != 0;
    if (!has_lights(lights, directional)) continue;
    if (!first) pass.barrier();
    first = false;
    pass.use(classify_program(shadows, directional));
    pass.push(kind);
    pass.dispatch_indirect(buffers.candidate_commands,
                           offsetof(shaders::ShadowCandidateCommands, candidates) + kind * sizeof(uvec4));
  }
}

void add_pairs_pass(FrameBuilder& frame, const ShadowsOutputs& shadows, FinalListBuffers& buffers) {
  FinalLists& lists = buffers.lists;
  const LightsOutputs& lights = frame.get<LightsOutputs>();
  const auto program = [&](std::uint32_t kind) {
    return generate_program(shadows, lists.visibility_bits, kind, frame.services().device.info());
  };
  const std::vector<std::uint32_t> kinds = kinds_of(lights);
  ComputePass pass(frame, "generate_shadows", program(kinds.empty() ? GLOAM_PAIRS_IN_FACE : kinds.front()));
  read_geometry(pass, frame.get<GeometryOutputs>());
  read_light_lists(pass, lights);
  read_shadows(pass, shadows);
  pass.read("final_grid", lists.grid);
  pass.read("pairs", buffers.pairs);
  pass.read("commands", lists.commands);
  pass.items<std::uint32_t>("reserved_tiles", buffers.reserved_tiles);
  lists.entries = pass.write("entries", lists.entries);
  lists.counters = pass.write("counters", lists.counters);
  write_visibilities(pass, lists);
  for (const std::uint32_t kind : kinds) {
    // Pairs of different kinds write to different places of the same buffers.
    if (kind != kinds.front()) pass.barrier();
    pass.use(program(kind));
    pass.dispatch_indirect(lists.commands, offsetof(shaders::ShadowListCommands, pairs) + kind * sizeof(uvec4));
  }
}

void add_finish_pass(FrameBuilder& frame, bool keys, FinalLists& lists) {
  ComputePass pass(frame, "finish_lists", finish_program(keys));
  if (keys) lists.kept_tiles = pass.write("kept_tiles", lists.kept_tiles);
  pass.read("final_grid", lists.grid);
  lists.tiles = pass.write("final_tiles", lists.tiles);
  lists.entries = pass.write("entries", lists.entries);
  lists.fallback_tiles = pass.write("fallback_tiles", lists.fallback_tiles);
  lists.counters = pass.write("counters", lists.counters);
  lists.commands = pass.write("commands", lists.commands);
  const gpu::ImageDesc& tiles = frame.graph().desc(lists.tiles);
  pass.dispatch_over(tiles.width, tiles.height);
}

/// Appends the pipelines of frames that make keys.
void list_reuse_pipelines(std::uint32_t visibility_bits, ShadowReuse reuse, const ShadowsOutputs& shadows,
                          PipelineList& list) {
  list.push_back(pipeline_desc(list_program(shadows, visibility_bits, reuse), "shadows"));
  list.push_back(pipeline_desc(finish_program(true), "shadows"));
  if (reuse == ShadowReuse::reprojected) list.push_back(pipeline_desc(sources_program(), "shadows"));
}

/// Depth and face normal of the view's pixels (shaders/shadows/final_lists/find_sources.comp.glsl). instance: as in
/// ViewReuse.
Result<HistoryBuffer> kept_pixels(FrameBuilder& frame, std::uint64_t pixels, std::uint64_t instance) {
  gpu::BufferDesc desc;
  desc.name = "shadow_kept_pixels";
  desc.module = "shadows";
  desc.size = pixels * sizeof(uvec2);
  desc.usage = gpu::BufferUsage::storage;
  return frame.history_buffer(desc, {.reset = {.most_missed = 0}, .instance = instance});
}

/// Sets how the frame reprojects. pixels: of all tiles. last_indices must be set.
void plan_reprojection(FrameBuilder& frame, std::uint64_t pixels, const ListInputs& inputs, const ViewReuse& reuse,
                       Kept& kept) {
  const auto last = kept_pixels(frame, pixels, reuse.instance), now = kept_pixels(frame, pixels, 1 - reuse.instance);
  if (!frame.check(last) || !frame.check(now)) return;
  kept.last_pixels = *last;
  kept.pixels = *now;
  shaders::ReprojectBlock& block = kept.reproject;
  kept.exact_frames = reprojects_any(kept.last_indices) ? 0 : std::min(reuse.exact_frames + 1, 4u);
  block.last = reuse.view;
  block.moved = vec3(frame.view().position - reuse.position);
  // Four frames make each tile anew. After that all is exact, and frames may repeat each other.
  block.turned_on = kept.exact_frames < 4 && kept.last_pixels.filled() ? 1 : 0;
  block.phase = block.turned_on != 0 ? (reuse.turn + 1) % 4 : 0;
  block.sphere_count = static_cast<std::uint32_t>(inputs.moved.size());
  std::ranges::copy(inputs.moved, block.spheres);
}

/// Decides what the frame keeps of the last one: nothing, if what all tiles share has changed, or each light.
Kept plan_kept(FrameBuilder& frame, const ShadowKnobs& knobs, const ShadowsOutputs& shadows,
               const FinalListBuffers& buffers, const ListInputs& inputs, const ViewReuse& reuse) {
  Kept kept;
  std::vector<std::uint32_t> indices = last_indices(reuse.inputs, inputs);
  const bool reprojects = knobs.reuse == ShadowReuse::reprojected;
  if (!reprojects && !keeps_any(inputs, indices)) return kept;
  const FrameServices& services = frame.services();
  PipelineList list;
  list_reuse_pipelines(buffers.lists.visibility_bits, knobs.reuse, shadows, list);
  if (!services.wait_for_pipelines && !services.pipelines.request(list, services.log)) return kept;
  kept.last = use_kept_buffers(frame, buffers.sizes, reuse.instance);
  if (!frame.status().ok()) return kept;
  kept.reuse = knobs.reuse;
  if (!reuse.has_keys || !kept.last.filled) std::ranges::fill(indices, GLOAM_LIGHT_CHANGED);
  kept.last_indices = std::move(indices);
  if (reprojects) {
    const gpu::ImageDesc& tiles = frame.graph().desc(buffers.lists.tiles);
    plan_reprojection(frame, std::uint64_t{tiles.width} * tiles.height * GLOAM_SLOT_PIXELS, inputs, reuse, kept);
  }
  return kept;
}

}  // namespace

bool can_generate(const FrameBuilder& frame, const ShadowKnobs& knobs) {
  const LightsOutputs* lights = frame.find<LightsOutputs>();
  return knobs.deferred && knobs.levels != 0 && lights != nullptr && (lights->local_count == 0 || lights->has_lists());
}

void list_generate_pipelines(const ShadowKnobs& knobs, const ShadowsOutputs& shadows, const LightsOutputs& lights,
                             const gpu::DeviceInfo& device, PipelineList& list) {
  const auto add = [&](const ComputeProgram& program) { list.push_back(pipeline_desc(program, "shadows")); };
  const std::uint32_t bits = visibility_bits_of(knobs);
  add(list_program(shadows, bits, ShadowReuse::off));
  for (const bool directional : {false, true})
    if (has_lights(lights, directional)) add(classify_program(shadows, directional));
  add(finish_program(false));
  for (const std::uint32_t kind : kinds_of(lights)) add(generate_program(shadows, bits, kind, device));
  if (knobs.classify) list_shadow_plane_pipelines(list);
  if (knobs.reuse != ShadowReuse::off) list_reuse_pipelines(bits, knobs.reuse, shadows, list);
}

bool generate_pipelines_ready(const FrameBuilder& frame, const ShadowKnobs& knobs, const ShadowsOutputs& shadows) {
  const FrameServices& services = frame.services();
  if (services.wait_for_pipelines) return true;
  PipelineList list;
  ShadowKnobs without_reuse = knobs;
  without_reuse.reuse = ShadowReuse::off;
  list_generate_pipelines(without_reuse, shadows, *frame.find<LightsOutputs>(), services.device.info(), list);
  return services.pipelines.request(list, services.log);
}

std::optional<FinalLists> add_generate_passes(FrameBuilder& frame, const ShadowKnobs& knobs, ImageRef planes,
                                              const ViewMapState& maps, const ShadowsOutputs& shadows,
                                              ViewReuse& reuse) {
  const bool reuses = knobs.reuse != ShadowReuse::off;
  FinalListBuffers buffers = make_final_list_buffers(frame, knobs, *shadows.row_values, reuses ? &reuse : nullptr);
  if (!frame.status().ok()) return std::nullopt;
  Kept kept;
  if (reuses) {
    ListInputs inputs = list_inputs(frame, knobs, shadows, maps, buffers.sizes);
    kept = plan_kept(frame, knobs, shadows, buffers, inputs, reuse);
    const bool has_keys = kept.reuse != ShadowReuse::off;
    note_reuse(frame, maps, {has_keys, kept.reproject.phase, kept.exact_frames}, std::move(inputs), reuse);
    buffers.lists.has_anew = has_keys;
  }
  add_start_pass(frame, buffers);
  if (kept.reuse == ShadowReuse::reprojected) add_sources_pass(frame, kept);
  add_list_pass(frame, shadows, kept, buffers);
  add_classify_pass(frame, shadows, planes, buffers);
  if (!frame.status().ok()) return std::nullopt;  // nothing has written the pairs that the next pass reads
  add_pairs_pass(frame, shadows, buffers);
  add_finish_pass(frame, kept.reuse != ShadowReuse::off, buffers.lists);
  frame.put(buffers.note);
  return std::move(buffers.lists);
}

}  // namespace gloam
