// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "modules/shadows/final_lists/reuse.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/final_lists_shared.h"

namespace gloam {

/// Pairs and slots that an earlier frame's final lists needed, and the capacities computed from them; a view resource.
struct FinalListFeedback {
  std::uint32_t pairs_asked = 0;
  std::uint32_t slots_asked = 0;
  std::uint32_t pair_capacity = 0;  ///< capacity of the next frames; the same for all frames in flight
  std::uint32_t slot_capacity = 0;
  std::uint64_t pair_bound = 0;  ///< the most pairs that the frame could have needed
  std::uint64_t frame = 0;       ///< RenderView::frame of the frame
};

/// Values recorded when a frame is declared, for the later readback of its counters.
struct FinalListNote {
  std::uint32_t tiles = 0;  ///< shadow tiles of the view
  std::uint32_t slot_capacity = 0;
  std::uint32_t pair_capacity = 0;
  std::uint64_t list_bytes = 0;        ///< bytes of final entries, early lists and pairs
  std::uint64_t visibility_bytes = 0;  ///< bytes of visibility slots
  std::uint32_t visibility_bits = 8;
  std::uint64_t pair_bound = 0;   ///< the most pairs that the frame can need
  std::uint64_t frame = 0;        ///< RenderView::frame
  float min_contribution = 0.0f;  ///< ShadowKnobs::min_contribution
};

/// Name of the frame result (FrameBuilder::keep_result) that holds a ShadowListCounters.
inline constexpr const char* kShadowListResult = "shadow_list_counters";

/// Pairs and slots of at most this many bytes have room for all that the CPU's tile masks allow, regardless of
/// feedback. All lists then fit, and shading needs no fallback (FinalLists::always_complete).
inline constexpr std::uint64_t kCheapPairBytes = std::uint64_t{8} << 20;
inline constexpr std::uint64_t kCheapSlotBytes = std::uint64_t{16} << 20;
/// Least visibility slots and tile-light pairs per tile.
inline constexpr std::uint32_t kLeastSlotsPerTile = 2;
inline constexpr std::uint32_t kLeastPairsPerTile = 1;
/// The most memory that slots get because of a bound, before the need is known, in bytes.
inline constexpr std::uint64_t kMostBoundBytes = std::uint64_t{64} << 20;

/// The next capacity of a buffer that has room for `there` items, of which a frame needed `asked`: asked × 1.25,
/// between `least` and `most`. The capacity stays `there` while that is at least `asked` and `least`, and at most about
/// four times the result.
[[nodiscard]] std::uint32_t kept_capacity(std::uint32_t there, std::uint32_t asked, std::uint32_t least,
                                          std::uint32_t most);

/// The feedback from a frame's counters. note: of the same frame. last: the view's feedback so far, or null.
[[nodiscard]] FinalListFeedback final_list_feedback(const shaders::ShadowListCounters& counters,
                                                    const FinalListNote& note, const FinalListFeedback* last);

/// Pairs and slots that a frame's buffers have room for.
struct FinalListCapacities {
  std::uint32_t pairs = 0;
  std::uint32_t slots = 0;
  bool complete = false;  ///< there is room for all that the view can need
};
/// feedback: of the view, or null. pair_bound: the most pairs that the frame can need, each with at most one slot.
/// tiles: shadow tiles of the view. Below the limits of the knobs there is room for the capacities of the feedback, and
/// by room_for_items().
[[nodiscard]] FinalListCapacities final_list_capacities(const FinalListFeedback* feedback, std::uint64_t pair_bound,
                                                        std::uint32_t tiles, const ShadowKnobs& knobs,
                                                        const RenderView& view);

/// Writes the counters shadows.… of final lists into the sink.
void count_final_lists(const shaders::ShadowListCounters& counters, const FinalListNote& note, CounterSink& sink);

/// A view's final lists as created, before the first pass writes them.
struct FinalListBuffers {
  FinalLists lists;
  BufferRef pairs;
  BufferRef candidates;  ///< entries of tile lights that may cast, before classification; places as in pair_places.glsl
  BufferRef candidate_commands;                     ///< one ShadowCandidateCommands
  BufferRef tile_groups;                            ///< two ShadowTileGroup per shadow tile
  std::vector<std::uint32_t> reserved_tiles = {0};  ///< ReservedTiles::tiles, or one word if no tile is reserved
  KeptSizes sizes;                                  ///< of lists.kept_tiles, entries and visibilities
  FinalListNote note;
};
/// Bits of a visibility in a slot: 4 or 8.
[[nodiscard]] std::uint32_t visibility_bits_of(const ShadowKnobs& knobs);

/// Sets what other knobs change in the constants of `lists`, and in visibility_bits and always_complete.
void set_list_constants(const ShadowKnobs& knobs, FinalLists& lists);

/// Creates the view's images and buffers, with final_list_capacities() for the lights that cast by the CPU's tile
/// masks. LightsOutputs must be on the board. rows: one per local light. reuse: of the view; null if no frame keeps
/// visibilities. If there is no memory, the frame is given up.
[[nodiscard]] FinalListBuffers make_final_list_buffers(FrameBuilder& frame, const ShadowKnobs& knobs,
                                                       std::span<const shaders::ShadowRow> rows,
                                                       const ViewReuse* reuse);

}  // namespace gloam
