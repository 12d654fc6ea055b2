// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "modules/shadows/knobs.h"
#include "modules/shadows/outputs.h"
#include "shaders/shadows/final_lists_shared.h"

namespace gloam {

/// What an earlier frame's final lists asked for; a view resource.
struct FinalListFeedback {
  std::uint32_t pairs_asked = 0;
  std::uint32_t slots_asked = 0;
  std::uint32_t pair_capacity = 0;  ///< to make room for; one value for all frames in flight
  std::uint32_t slot_capacity = 0;
};

/// What is noted beside a frame's counters when it is declared.
struct FinalListNote {
  std::uint32_t tiles = 0;  ///< shadow tiles of the view
  std::uint32_t slot_capacity = 0;
  std::uint32_t pair_capacity = 0;
  std::uint64_t list_bytes = 0;        ///< of entries, early ones too, and of pairs
  std::uint64_t visibility_bytes = 0;  ///< of slots
  std::uint32_t visibility_bits = 8;
};

/// Name of the result (FrameBuilder::keep_result) that holds a ShadowListCounters.
inline constexpr const char* kShadowListResult = "shadow_list_counters";

/// Bytes of visibilities that a view may have at once without its frames asking for them, so that all lights fit and
/// shading needs no other way (FinalLists::always_complete).
inline constexpr std::uint64_t kBytesThatFitAll = std::uint64_t{8} << 20;
/// Slots a tile that a view has at least.
inline constexpr std::uint32_t kFirstSlotsPerTile = 2;
/// Pairs a tile that a view begins with: many, as its first picture may be the only one; and has at least when it knows
/// what frames ask for.
inline constexpr std::uint32_t kFirstPairsPerTile = 4;
inline constexpr std::uint32_t kLeastPairsPerTile = 1;

/// Room for `asked` and a quarter more; stays as it is while that is enough and it is not four times too large. At
/// least `least`.
[[nodiscard]] std::uint32_t kept_capacity(std::uint32_t there, std::uint32_t asked, std::uint32_t least,
                                          std::uint32_t most);

/// The feedback of a frame's counters. `last`: the view's feedback so far, null when there is none.
[[nodiscard]] FinalListFeedback final_list_feedback(const shaders::ShadowListCounters& counters,
                                                    const FinalListNote& note, const FinalListFeedback* last);

/// The counters shadows.… that the GPU counted.
void count_final_lists(const shaders::ShadowListCounters& counters, const FinalListNote& note, CounterSink& sink);

/// A view's final lists before the first pass that writes them.
struct FinalListBuffers {
  FinalLists lists;
  BufferRef pairs;
  gpu::Binding::BufferRange grid;  ///< a FinalGrid, uniform
  FinalListNote note;
};
/// Of a slot.
[[nodiscard]] std::uint32_t visibility_bits_of(const ShadowKnobs& knobs);

[[nodiscard]] Result<FinalListBuffers> make_final_list_buffers(FrameBuilder& frame, const ShadowKnobs& knobs);

}  // namespace gloam
