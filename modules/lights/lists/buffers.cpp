// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/lists/buffers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>

#include "engine/render/readback/item_need.h"
#include "modules/lights/knobs.h"
#include "modules/lights/lists/uploads.h"
#include "modules/lights/masks/mask_population.h"

namespace gloam {
namespace {

constexpr std::uint32_t kNoSurface =
    0x3F800000u;  // bits of depth 1.0: the initial value of farthest_depth, left unchanged if no surface is visible

constexpr std::uint64_t words_to_entries(std::uint64_t words) { return 3 * words; }
constexpr std::uint32_t to_whole_words(std::uint64_t entries) {
  return static_cast<std::uint32_t>(std::min((entries + 2) / 3 * 3, words_to_entries(kMostListBytes / 4)));
}

uvec2 shadow_tiles_of(const RenderView& view) {
  return (uvec2(view.width, view.height) + uvec2(GLOAM_SHADOW_TILE - 1)) / uvec2(GLOAM_SHADOW_TILE);
}

/// Entries that the view's frame should have room for; entry_bound: the most that it can need.
std::uint32_t room_for_entries(const LightFeedback* feedback, std::uint64_t entry_bound, const RenderView& view) {
  std::optional<ItemNeed> known;
  if (feedback != nullptr) known = ItemNeed{feedback->entries_asked, feedback->entry_bound, feedback->frame};
  return to_whole_words(room_for_items(known, entry_bound, words_to_entries(kCheapListBytes / 4), view));
}

gpu::BufferDesc lists_buffer(const char* name, std::uint64_t words) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = "lights";
  desc.size = 4 * words;
  return desc;
}

}  // namespace

LightFeedback light_feedback(const shaders::LightCounters& counters, const LightCountersNote& note,
                             const LightFeedback* last) {
  LightFeedback feedback{.entries_asked = counters.slots,
                         .slot_capacity = last == nullptr ? note.slot_capacity : last->slot_capacity,
                         .entry_bound = note.entry_bound,
                         .frame = note.view.frame};
  const uvec2 tiles = shadow_tiles_of(note.view);
  feedback.slot_capacity = list_capacity(tiles.x * tiles.y, 0, feedback);
  if (counters.farthest_depth != kNoSurface) {
    const float metres = note.view.view_depth(std::bit_cast<float>(counters.farthest_depth));
    if (std::isfinite(metres) && metres > 0.0f) feedback.farthest_m = metres;
  }
  return feedback;
}

void count_lights(const shaders::LightCounters& counters, const LightCountersNote& note, CounterSink& sink) {
  const double tiles = std::max(1.0, static_cast<double>(counters.tiles));
  sink.count("lights.per_tile_mask_mean", counters.mask_lights / tiles);
  sink.count("lights.per_tile_candidates_mean", counters.candidate_lights / tiles);
  sink.count("lights.per_tile_approx_mean", counters.approx_lights / tiles);
  sink.count("lights.per_tile_group_mean", counters.group_lights / tiles);
  sink.count("lights.per_tile_accurate_mean", counters.accurate_lights / tiles);
  sink.count("lights.list_entries", counters.slots);
  sink.count("lights.list_capacity", note.slot_capacity);
  sink.count("lights.overflow_tiles", counters.overflow_tiles);
  sink.count("lights.capacity_violations", counters.violations);
  if (note.checked) sink.count("lights.culling_errors", counters.culling_errors);
}

std::uint32_t list_capacity(std::uint32_t tiles, std::uint32_t fixed_slots, const LightFeedback& feedback) {
  if (fixed_slots > 0) return to_whole_words(std::uint64_t{tiles} * fixed_slots);
  const std::uint32_t asked = to_whole_words(std::uint64_t{feedback.entries_asked} * 5 / 4);
  const std::uint32_t needed = std::max(to_whole_words(std::uint64_t{tiles} * kLeastEntriesPerTile), asked);
  const std::uint32_t there = feedback.slot_capacity;
  const bool keeps = there >= feedback.entries_asked &&
                     there >= to_whole_words(std::uint64_t{tiles} * kLeastEntriesPerTile) && there / 4 <= needed;
  return keeps ? there : needed;
}

bool light_lists_will_fit(const FrameBuilder& frame) {
  const World& world = frame.world();
  const ViewId view = frame.view().id;
  if (local_lights(world.view_resource<VisibleLights>(view)).empty()) return true;
  const bool flexible =
      frame.knobs().value(kLightCulling) == LightCulling::tiled && frame.knobs().value(kFixedLightSlots) == 0;
  if (!flexible || !world.view_resource<ListRoom>(view).all) return false;
  const std::uint64_t bound =
      mask_population(world.view_resource<TileLightMasks>(view), shadow_tiles_of(frame.view()), {}, 3);
  return bound <= words_to_entries(kMostListBytes / 4);
}

std::uint64_t most_tile_lights_of(const FrameBuilder& frame, std::span<const std::uint32_t> tiles,
                                  std::span<const std::uint32_t> chosen) {
  const World& world = frame.world();
  if (local_lights(world.view_resource<VisibleLights>(frame.view().id)).empty()) return 0;
  return mask_population_of(world.view_resource<TileLightMasks>(frame.view().id), shadow_tiles_of(frame.view()), tiles,
                            chosen);
}

void upload_light_lists(FrameBuilder& frame, const ZBins& bins, const TileLightMasks& masks, LightsOutputs& outputs) {
  const RenderView& view = frame.view();
  const uvec2 tiles = shadow_tiles_of(view);
  const std::uint32_t tile_count = tiles.x * tiles.y;
  const uvec2 groups = (tiles + uvec2(GLOAM_TILE_GROUP - 1)) / uvec2(GLOAM_TILE_GROUP);
  const LightFeedback* feedback = frame.world().try_view_resource<LightFeedback>(view.id);

  shaders::LightGrid grid{};
  grid.tiles = tiles;
  grid.groups = groups;
  grid.mask_tiles = masks.tiles;
  grid.local_count = outputs.local_count;
  grid.z_bin_count = bins.params.count;
  grid.z_near = bins.params.near_m;
  grid.z_scale = bins.params.scale();
  grid.fixed_slots = fixed_slots_of(frame.knobs().value(kFixedLightSlots));
  grid.slot_capacity = list_capacity(tile_count, grid.fixed_slots, feedback == nullptr ? LightFeedback{} : *feedback);
  outputs.masks = &masks;
  outputs.entry_bound = mask_population(masks, tiles, {}, 3);
  if (grid.fixed_slots == 0)
    grid.slot_capacity =
        std::max({grid.slot_capacity, room_for_entries(feedback, outputs.entry_bound, view),
                  to_whole_words(std::uint64_t{tile_count} * entries_that_fit_all(grid.local_count, tile_count))});
  if (grid.fixed_slots == 0 && frame.world().view_resource<ListRoom>(view.id).all)
    grid.slot_capacity = std::max(grid.slot_capacity, to_whole_words(coarse_capacity(outputs.entry_bound)));
  const std::uint64_t most =
      grid.fixed_slots == 0 ? outputs.entry_bound : std::uint64_t{tile_count} * ((grid.local_count + 2) / 3 * 3);
  outputs.lists_always_fit = grid.slot_capacity >= most;
  outputs.slot_capacity = grid.slot_capacity;

  outputs.grid = frame.upload_uniform(grid);
  add_light_uploads(frame, bins, masks, outputs);

  FrameGraph& graph = frame.graph();
  outputs.group_masks =
      graph.create_buffer(lists_buffer("light_group_masks", std::uint64_t{groups.x} * groups.y * GLOAM_MASK_WORDS));
  outputs.early_lists = graph.create_buffer(lists_buffer("early_light_lists", grid.slot_capacity / 3));
  outputs.counters = graph.create_buffer(lists_buffer("light_counters", sizeof(shaders::LightCounters) / 4));
  gpu::ImageDesc lists;
  lists.name = "tile_light_lists";
  lists.module = "lights";
  lists.format = gpu::Format::rg32_uint;
  lists.width = tiles.x;
  lists.height = tiles.y;
  outputs.tile_lists = graph.create_image(lists);
}

void record_counters_start(gpu::CommandList& commands, gpu::BufferHandle counters) {
  constexpr std::uint64_t kFarthest = offsetof(shaders::LightCounters, farthest_depth);
  constexpr std::uint64_t kAfter = kFarthest + sizeof(std::uint32_t);
  commands.fill_buffer(counters, 0, kFarthest, 0);
  commands.fill_buffer(counters, kFarthest, sizeof(std::uint32_t), kNoSurface);
  commands.fill_buffer(counters, kAfter, sizeof(shaders::LightCounters) - kAfter, 0);
}

}  // namespace gloam
