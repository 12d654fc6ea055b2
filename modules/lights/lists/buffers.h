// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/frame/transfers/results.h"
#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "modules/lights/bins/z_bins.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/outputs.h"
#include "modules/lights/selection/light_list.h"

namespace gloam {

/// Results of the searches of an earlier frame of a view; a view resource.
struct LightFeedback {
  std::uint32_t entries_asked = 0;  ///< list entries the frame needed
  std::uint32_t slot_capacity = 0;  ///< list entries to allocate, shared by all frames in flight (see light_feedback)
  float farthest_m = 0.0f;        ///< view depth of the farthest opaque surface; 0: unknown, or no surface was visible
  std::uint64_t entry_bound = 0;  ///< the most entries that the frame could have needed
  std::uint64_t frame = 0;        ///< RenderView::frame of the frame
};

/// Recorded with a frame's counters when its passes are declared, and read when the counters come back.
struct LightCountersNote {
  RenderView view;
  std::uint32_t slot_capacity = 0;
  bool checked = false;           ///< culling errors were counted (lights.check)
  std::uint64_t entry_bound = 0;  ///< the most entries that the frame can need
};

/// Name of the result (FrameBuilder::keep_result) that holds the LightCounters.
inline constexpr const char* kLightCountersResult = "light_counters";

/// `last`: the view's current feedback, null if there is none. The new capacity is computed from the capacity in
/// `last`, not from the capacity of the frame that counted: otherwise each frame in flight would keep a different
/// capacity, and the lists would be resized in every frame.
[[nodiscard]] LightFeedback light_feedback(const shaders::LightCounters& counters, const LightCountersNote& note,
                                           const LightFeedback* last);

/// Reports the GPU's LightCounters as counters lights.….
void count_lights(const shaders::LightCounters& counters, const LightCountersNote& note, CounterSink& sink);

/// Upper limit of a view's lists, in bytes.
inline constexpr std::uint64_t kMostListBytes = std::uint64_t{128} << 20;
/// Lists of at most this many bytes have room for all that the CPU's tile masks allow.
inline constexpr std::uint64_t kCheapListBytes = std::uint64_t{8} << 20;
/// Least list entries per tile.
inline constexpr std::uint32_t kLeastEntriesPerTile = 3;
/// Upper limit, in bytes, of lists sized to hold every light in every tile (entries_that_fit_all).
inline constexpr std::uint64_t kListBytesThatFitAll = std::uint64_t{512} << 10;

/// Entries per tile that let every list hold all local lights, so that shading needs no fallback
/// (LightsOutputs::lists_always_fit). 0: too many lights or too many tiles. In steps, so that buffers are not resized
/// for every light that comes into view.
[[nodiscard]] constexpr std::uint32_t entries_that_fit_all(std::uint32_t local_count, std::uint32_t tiles) {
  const std::uint32_t entries = local_count > 24 ? 48 : 24;
  return local_count <= 48 && std::uint64_t{tiles} * entries / 3 * 4 <= kListBytesThatFitAll ? entries : 0;
}

/// Entries per tile in fixed-slot mode: the knob, rounded up to whole words (3 entries). 0: as many as the tile needs.
[[nodiscard]] constexpr std::uint32_t fixed_slots_of(std::uint32_t knob) { return (knob + 2) / 3 * 3; }

/// List entries to allocate, a multiple of 3. With `fixed_slots`: that many per tile. Otherwise: 1.25 times the entries
/// an earlier frame needed, at least kLeastEntriesPerTile per tile. Shrinks only if the capacity is more than four
/// times too large, so that a moving camera does not reallocate all the time.
[[nodiscard]] std::uint32_t list_capacity(std::uint32_t tiles, std::uint32_t fixed_slots,
                                          const LightFeedback& feedback);

/// Uploads the inputs of the searches and of shading, and declares the list buffers. They have room for list_capacity()
/// entries, and by room_for_items(), whose bound comes from the CPU's tile masks, so that no list overflows. `outputs`:
/// local_count must be set; fills grid and all fields after it.
void upload_light_lists(FrameBuilder& frame, const ZBins& bins, const TileLightMasks& masks, LightsOutputs& outputs);

/// Writes the initial values of a view's LightCounters. Record it in a pass that writes the buffer with transfer_write.
void record_counters_start(gpu::CommandList& commands, gpu::BufferHandle counters);

}  // namespace gloam
