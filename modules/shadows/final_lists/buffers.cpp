// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/final_lists/buffers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "engine/render/readback/item_need.h"
#include "engine/scene/resources.h"
#include "modules/lights/outputs.h"
#include "modules/shadows/atlas/view_faces.h"

namespace gloam {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{4} * GLOAM_BUFFER_WORDS;  // bytes of one buffer
constexpr std::uint32_t kMostSlots = GLOAM_NO_ROOM;  // slot numbers are 0 … GLOAM_NO_ROOM − 1
constexpr float kWhiteAtEv0 = 1.2f;                  // cd/m²
constexpr std::uint32_t kMostRows = 65535;           // the least maxComputeWorkGroupCount that Vulkan allows
/// More tile lights than this are filtered without classification.
constexpr std::uint32_t kMostCandidates = 2u << 20;
static_assert(kMostCandidates <= kMostRows * GLOAM_CANDIDATE_GROUP, "they are dispatched in one row of workgroups");
constexpr std::uint32_t kMostPairs = kMostRows * GLOAM_PAIRS_ROW;
static_assert(2 * sizeof(std::uint32_t) * kMostPairs <= kMostBytes, "local and directional pairs share one buffer");

std::uint32_t slot_bytes(std::uint32_t bits) { return GLOAM_SLOT_PIXELS * bits / 8; }
std::uint32_t slots_per_buffer(std::uint32_t bits) { return static_cast<std::uint32_t>(kMostBytes / slot_bytes(bits)); }

std::uint32_t at_most(std::uint64_t count, std::uint32_t most) {
  return static_cast<std::uint32_t>(std::min<std::uint64_t>(count, most));
}

BufferRef create(FrameGraph& graph, const char* name, std::uint64_t bytes) {
  gpu::BufferDesc desc;
  desc.name = name;
  desc.module = "shadows";
  desc.size = std::max<std::uint64_t>(bytes, 4);
  return graph.create_buffer(desc);
}

/// The most tile-light pairs that the view's tiles can need. Each takes at most one slot, of whichever module.
std::uint64_t bound_of_pairs(const FrameBuilder& frame, std::span<const shaders::ShadowRow> rows, uvec2 tiles) {
  const LightsOutputs& lights = *frame.find<LightsOutputs>();
  const std::span<const Entity> entities = local_lights(frame.world().view_resource<VisibleLights>(frame.view().id));
  const WithheldCasters* withheld = frame.find<WithheldCasters>();
  std::vector<std::uint32_t> casting((lights.local_count + 31) / 32, 0);
  for (std::size_t i = 0; i < std::min<std::size_t>(rows.size(), lights.local_count); ++i) {
    const bool has_map = rows[i].kind != static_cast<float>(GLOAM_SHADOW_NONE);
    const bool drawn_elsewhere = withheld != nullptr && !withheld->of(entities[i]).empty();
    if (has_map || drawn_elsewhere) casting[i / 32] |= 1u << (i % 32);
  }
  return most_tile_lights(lights, tiles, casting) + std::uint64_t{tiles.x} * tiles.y * lights.directional_count;
}

/// Gives the reserved tiles their slots, and room for the pairs of all tiles. reserve_tiles() has checked the limits.
void add_reserved(const ReservedTiles& reserved, std::uint64_t pair_bound, const ShadowKnobs& knobs,
                  FinalListCapacities& c) {
  c.pairs = std::max(c.pairs, at_most(coarse_capacity(pair_bound), std::min(kMostPairs, knobs.pair_limit)));
  c.slots = at_most(std::uint64_t{reserved.slots} + c.slots, std::min(kMostSlots, knobs.slot_limit));
}

gpu::SpecConstants list_constants(std::uint32_t visibility_bits, bool split, bool reuse) {
  gpu::SpecConstants constants;
  constants.set_if_present("kReuse", reuse ? 1u : 0u);
  constants.set_if_present("kVisibilityBits", visibility_bits);
  constants.set_if_present("kVisibilityBuffers", split ? 2u : 1u);
  return constants;
}

/// Creates entries and visibilities. reuse: null if no frame keeps them.
void create_lists(FrameBuilder& frame, const KeptSizes& sizes, const ViewReuse* reuse, FinalLists& lists) {
  FrameGraph& graph = frame.graph();
  const bool split = sizes.visibilities[1] != 0;
  lists.constants = list_constants(lists.visibility_bits, split, reuse != nullptr);
  if (reuse != nullptr) {
    const KeptBuffers kept = use_kept_buffers(frame, sizes, 1 - reuse->instance);
    lists.kept_tiles = kept.tiles;
    lists.entries = kept.entries;
    std::ranges::copy(kept.visibilities, lists.visibilities);
    return;
  }
  lists.kept_tiles = create(graph, "shadow_kept_tiles", sizeof(shaders::KeptTile));
  lists.entries = create(graph, "final_light_entries", sizes.entries);
  lists.visibilities[0] = lists.visibilities[1] = create(graph, "shadow_visibilities", sizes.visibilities[0]);
  if (split) lists.visibilities[1] = create(graph, "more_shadow_visibilities", sizes.visibilities[1]);
}

/// FinalGrid::dim_light
float dim_light(const FrameBuilder& frame, const ShadowKnobs& knobs) {
  if (!(knobs.min_contribution > 0.0f)) return 0.0f;
  const float ev100 = frame.world().resource<SceneEnvironment>().exposure_ev100;
  return knobs.min_contribution * kWhiteAtEv0 * std::exp2(ev100) * frame.view().light_scale;
}

KeptSizes sizes_of(const FinalLists& lists, std::uint64_t entries, std::uint64_t tiles) {
  const std::uint32_t bits = lists.visibility_bits, first = std::min(lists.slot_capacity, slots_per_buffer(bits));
  return {.tiles = tiles * sizeof(shaders::KeptTile),
          .entries = entries * sizeof(std::uint32_t),
          .visibilities = {std::uint64_t{first} * slot_bytes(bits),
                           std::uint64_t{lists.slot_capacity - first} * slot_bytes(bits)}};
}

}  // namespace

void set_list_constants(const ShadowKnobs& knobs, FinalLists& lists) {
  const bool split = lists.visibilities[1].resource != lists.visibilities[0].resource;
  lists.visibility_bits = visibility_bits_of(knobs);
  lists.constants = list_constants(lists.visibility_bits, split, knobs.reuse != ShadowReuse::off);
  const ShadowKnobs unlimited;
  if (knobs.slot_limit != unlimited.slot_limit || knobs.pair_limit != unlimited.pair_limit)
    lists.always_complete = false;
}

std::uint32_t kept_capacity(std::uint32_t there, std::uint32_t asked, std::uint32_t least, std::uint32_t most) {
  const std::uint32_t needed = std::max(least, at_most(std::uint64_t{asked} * 5 / 4, most));
  const bool keeps = there >= asked && there >= least && there / 4 <= needed;
  return std::min(keeps ? there : needed, most);
}

FinalListFeedback final_list_feedback(const shaders::ShadowListCounters& counters, const FinalListNote& note,
                                      const FinalListFeedback* last) {
  FinalListFeedback feedback;
  // Tile lights that were kept need pairs again as soon as they change.
  feedback.pairs_asked =
      std::max(counters.pairs, last == nullptr || counters.kept + counters.reprojected == 0 ? 0 : last->pairs_asked);
  // Pairs that did not fit took no slots: assume that they need as many slots per pair as the pairs that fit.
  const bool pairs_full = counters.pairs > note.pair_capacity;
  const std::uint64_t share =
      pairs_full ? std::uint64_t{counters.slots} * counters.pairs / std::max(note.pair_capacity, 1u) : counters.slots;
  feedback.slots_asked = at_most(std::max<std::uint64_t>(share, counters.slots), kMostSlots);
  const std::uint32_t least = at_most(std::uint64_t{note.tiles} * kLeastSlotsPerTile, kMostSlots);
  const std::uint32_t least_pairs = at_most(std::uint64_t{note.tiles} * kLeastPairsPerTile, kMostPairs);
  // The first capacities are bounds and are not kept.
  feedback.pair_capacity =
      kept_capacity(last == nullptr ? 0 : last->pair_capacity, feedback.pairs_asked, least_pairs, kMostPairs);
  feedback.slot_capacity =
      kept_capacity(last == nullptr ? 0 : last->slot_capacity, feedback.slots_asked, least, kMostSlots);
  feedback.pair_bound = note.pair_bound;
  feedback.frame = note.frame;
  return feedback;
}

FinalListCapacities final_list_capacities(const FinalListFeedback* feedback, std::uint64_t pair_bound,
                                          std::uint32_t tiles, const ShadowKnobs& knobs, const RenderView& view) {
  const std::uint32_t bits = visibility_bits_of(knobs);
  const FinalListFeedback asked = feedback == nullptr ? FinalListFeedback{} : *feedback;
  const std::uint32_t least_slots = at_most(std::uint64_t{tiles} * kLeastSlotsPerTile, kMostSlots);
  const std::uint32_t least_pairs = at_most(std::uint64_t{tiles} * kLeastPairsPerTile, kMostPairs);
  std::optional<ItemNeed> pairs, slots;
  if (feedback != nullptr) {
    pairs = ItemNeed{asked.pairs_asked, asked.pair_bound, asked.frame};
    slots = ItemNeed{asked.slots_asked, asked.pair_bound, asked.frame};
  }
  const std::uint64_t room_for_pairs = room_for_items(pairs, pair_bound, kCheapPairBytes / sizeof(std::uint32_t), view);
  const std::uint64_t room_for_slots = std::min(
      room_for_items(slots, pair_bound, kCheapSlotBytes / slot_bytes(bits), view), kMostBoundBytes / slot_bytes(bits));
  FinalListCapacities c;
  c.pairs = std::max(kept_capacity(asked.pair_capacity, asked.pairs_asked, least_pairs, kMostPairs),
                     at_most(room_for_pairs, kMostPairs));
  c.slots = std::max(kept_capacity(asked.slot_capacity, asked.slots_asked, least_slots, kMostSlots),
                     at_most(room_for_slots, kMostSlots));
  c.pairs = std::min(c.pairs, knobs.pair_limit);
  c.slots = std::min(c.slots, knobs.slot_limit);
  c.complete = c.pairs >= pair_bound && c.slots >= pair_bound;
  return c;
}

void count_final_lists(const shaders::ShadowListCounters& c, const FinalListNote& note, CounterSink& sink) {
  const double candidates = std::max(1.0, static_cast<double>(c.candidates));
  sink.count("shadows.tile_lights", c.candidates);
  sink.count("shadows.tile_lights_unshadowed", c.unshadowed);
  sink.count("shadows.tile_lights_lit", c.lit_at_once);
  sink.count("shadows.tile_lights_unlit", c.unlit_at_once);
  sink.count("shadows.tile_lights_kept", c.kept);
  sink.count("shadows.tile_lights_reprojected", c.reprojected);
  sink.count("shadows.tile_lights_filtered", c.pairs);
  sink.count("shadows.tile_lights_filtered_lit", c.lit_by_filter);
  sink.count("shadows.tile_lights_filtered_unlit", c.unlit_by_filter);
  sink.count("shadows.tile_lights_dim", c.dim);
  sink.count("shadows.dim_light", std::bit_cast<float>(c.dim_light) * note.min_contribution);
  sink.count("shadows.classified_share", 1.0 - c.pairs / candidates);
  sink.count("shadows.slots", c.slots);
  sink.count("shadows.slots_reserved", c.reserved_slots);
  sink.count("shadows.slot_capacity", note.slot_capacity);
  sink.count("shadows.pair_capacity", note.pair_capacity);
  sink.count("shadows.fallback_tiles", c.fallback_tiles);
  sink.count("shadows.list_bytes", static_cast<double>(note.list_bytes));
  sink.count("shadows.visibility_bytes", static_cast<double>(note.visibility_bytes));
  sink.count("shadows.fixed_list_bytes", note.tiles * 32.0 * (4.0 / 3.0 + 4.0));
  sink.count("shadows.fixed_visibility_bytes", note.tiles * 32.0 * slot_bytes(note.visibility_bits));
}

std::uint32_t visibility_bits_of(const ShadowKnobs& knobs) { return knobs.levels == 15 ? 4 : 8; }

std::optional<ReservedTiles> reserve_tiles(const FrameBuilder& frame, std::vector<std::uint32_t> tiles,
                                           std::span<const Entity> lights) {
  if (!light_lists_will_fit(frame)) return std::nullopt;
  const ShadowKnobs knobs = shadow_knobs(frame.knobs());
  const VisibleLights& visible = frame.world().view_resource<VisibleLights>(frame.view().id);
  const std::vector<shaders::ShadowRow>& rows = frame.world().view_resource<ViewFaces>(frame.view().id).rows;
  const std::span<const Entity> local = local_lights(visible);
  std::vector<std::uint32_t> casting((local.size() + 31) / 32, 0);
  for (std::size_t i = 0; i < local.size(); ++i) {
    const bool has_map = i < rows.size() && rows[i].kind != static_cast<float>(GLOAM_SHADOW_NONE);
    if (has_map || std::ranges::find(lights, local[i]) != lights.end()) casting[i / 32] |= 1u << (i % 32);
  }
  const uvec2 size = (uvec2(frame.view().width, frame.view().height) + uvec2(kShadowTile - 1)) / uvec2(kShadowTile);
  const std::uint64_t all_tiles = std::uint64_t{size.x} * size.y, suns = directional_lights(visible).size();
  std::uint64_t count = 0;
  for (const std::uint32_t word : tiles) count += static_cast<std::uint64_t>(std::popcount(word));
  const std::vector<std::uint32_t> every((all_tiles + 31) / 32, ~0u);
  const std::uint64_t pairs = most_tile_lights_of(frame, every, casting) + all_tiles * suns;
  const std::uint64_t slots = most_tile_lights_of(frame, tiles, casting) + count * suns;
  // Early lists have at most three entries a light and tile.
  const bool entries_fit =
      all_tiles * suns + 2 * most_tile_lights_of(frame, every, {}) + 3 * all_tiles <= kMostBytes / 4;
  const std::uint64_t most_slots =
      std::min<std::uint64_t>({kMostSlots, knobs.slot_limit, kMostBoundBytes / slot_bytes(visibility_bits_of(knobs))});
  if (!entries_fit || pairs > std::min(kMostPairs, knobs.pair_limit) || slots > most_slots) return std::nullopt;
  return ReservedTiles{std::move(tiles), at_most(coarse_capacity(std::max<std::uint64_t>(slots, 1)),
                                                 static_cast<std::uint32_t>(most_slots))};
}

FinalListBuffers make_final_list_buffers(FrameBuilder& frame, const ShadowKnobs& knobs,
                                         std::span<const shaders::ShadowRow> rows, const ViewReuse* reuse) {
  FrameGraph& graph = frame.graph();
  const LightsOutputs& lights = *frame.find<LightsOutputs>();
  const uvec2 tiles = (uvec2(frame.view().width, frame.view().height) + uvec2(kShadowTile - 1)) / uvec2(kShadowTile);
  const std::uint32_t tile_count = tiles.x * tiles.y;
  FinalListBuffers made;
  FinalLists& lists = made.lists;
  lists.visibility_bits = visibility_bits_of(knobs);
  const std::uint64_t pair_bound = bound_of_pairs(frame, rows, tiles);
  const auto* feedback = frame.world().try_view_resource<FinalListFeedback>(frame.view().id);
  FinalListCapacities c = final_list_capacities(feedback, pair_bound, tile_count, knobs, frame.view());
  const auto* reserved = c.complete ? nullptr : frame.find<ReservedTiles>();
  if (reserved != nullptr) {
    add_reserved(*reserved, pair_bound, knobs, c);
    made.reserved_tiles = reserved->tiles;
  }
  lists.pair_capacity = c.pairs;
  lists.slot_capacity = c.slots;

  shaders::FinalGrid grid{};
  grid.tiles = tiles;
  grid.directional_count = lights.directional_count;
  grid.has_early_lists = lights.has_lists() ? 1 : 0;
  const std::uint64_t entries =
      std::uint64_t{tile_count} * lights.directional_count + (lights.has_lists() ? lights.slot_capacity : 0);
  grid.entry_capacity = at_most(entries, kMostBytes / sizeof(std::uint32_t));
  grid.candidate_capacity = at_most(pair_bound, kMostCandidates);
  grid.pair_capacity = c.pairs;
  grid.slot_capacity = c.slots;
  grid.reserved_slots = reserved == nullptr ? 0 : reserved->slots;
  grid.dim_light = dim_light(frame, knobs);
  grid.classify = knobs.classify && knobs.early_outs ? 1 : 0;
  lists.always_complete =
      c.complete && grid.entry_capacity == entries && (!lights.has_lists() || lights.lists_always_fit);
  auto range = frame.services().uniforms.write_value(grid);
  if (frame.check(range)) lists.grid = *range;

  gpu::ImageDesc image;
  image.name = "final_light_lists";
  image.module = "shadows";
  image.format = gpu::Format::rgba32_uint;
  image.width = tiles.x;
  image.height = tiles.y;
  lists.tiles = graph.create_image(image);
  constexpr std::uint64_t kWord = sizeof(std::uint32_t);
  const std::uint64_t directional = std::uint64_t{tile_count} * lights.directional_count;
  const std::uint64_t pairs = c.pairs + std::min<std::uint64_t>(c.pairs, directional);
  const std::uint64_t candidates =
      grid.candidate_capacity + std::min<std::uint64_t>(grid.candidate_capacity, directional);
  made.pairs = create(graph, "shadow_pairs", kWord * pairs);
  made.candidates = create(graph, "shadow_candidates", kWord * candidates);
  made.candidate_commands = create(graph, "shadow_candidate_commands", sizeof(shaders::ShadowCandidateCommands));
  const std::uint64_t group_bytes = grid.classify != 0 ? 2 * sizeof(shaders::ShadowTileGroup) * tile_count : 0;
  made.tile_groups = create(graph, "shadow_tile_groups", group_bytes);
  lists.fallback_tiles = create(graph, "shadow_fallback_tiles", kWord * tile_count);
  lists.commands = create(graph, "shadow_list_commands", sizeof(shaders::ShadowListCommands));
  lists.counters = create(graph, "shadow_list_counters", sizeof(shaders::ShadowListCounters));
  lists.fallback_draw = offsetof(shaders::ShadowListCommands, fallback_draw);
  made.sizes = sizes_of(lists, grid.entry_capacity, tile_count);
  create_lists(frame, made.sizes, reuse, lists);
  made.note = {tile_count,
               c.slots,
               c.pairs,
               kWord * (std::uint64_t{grid.entry_capacity} + pairs + candidates) + group_bytes +
                   (lights.has_lists() ? std::uint64_t{lights.slot_capacity} / 3 * kWord : 0),
               std::uint64_t{c.slots} * slot_bytes(lists.visibility_bits),
               lists.visibility_bits,
               pair_bound,
               frame.view().frame,
               knobs.min_contribution};
  return made;
}

}  // namespace gloam
