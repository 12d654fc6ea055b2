// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/core/result.h"
#include "engine/frame/frame_results.h"
#include "engine/render/frame_builder.h"
#include "engine/render/module.h"
#include "modules/lights/bins/z_bins.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/outputs.h"
#include "modules/lights/selection/light_list.h"

namespace gloam {

/// What the searches of an earlier frame found out about a view; a view resource.
struct LightFeedback {
  std::uint32_t entries_asked = 0;  ///< of the lists
  std::uint32_t slot_capacity =
      0;                    ///< entries to make room for; one value for all frames in flight, see light_feedback
  float farthest_m = 0.0f;  ///< view depth of the farthest opaque surface; 0: unknown, or there was none
};

/// What is noted beside a frame's counters when it is declared.
struct LightCountersNote {
  RenderView view;
  std::uint32_t slot_capacity = 0;
  bool checked = false;  ///< culling errors were counted
};

/// Name of the result (FrameBuilder::keep_result) that holds a LightCounters.
inline constexpr const char* kLightCountersResult = "light_counters";

/// `last`: the view's feedback so far, null when there is none. Its capacity goes on from there, not from that of the
/// frame that counted: frames in flight would each follow their own, and lists change their size from frame to frame
/// for ever.
[[nodiscard]] LightFeedback light_feedback(const shaders::LightCounters& counters, const LightCountersNote& note,
                                           const LightFeedback* last);

/// The counters lights.… that the GPU counted.
void count_lights(const shaders::LightCounters& counters, const LightCountersNote& note, CounterSink& sink);

/// Bytes a view's lists may have.
inline constexpr std::uint64_t kMostListBytes = std::uint64_t{128} << 20;
/// Entries a tile that a view's lists begin with.
inline constexpr std::uint32_t kFirstEntriesPerTile = 3;
/// Bytes of lists that are spent on room for all lights in every list (entries_that_fit_all), and no more.
inline constexpr std::uint64_t kListBytesThatFitAll = std::uint64_t{512} << 10;

/// Entries a tile that few local lights get without being asked for, so that all of them fit into every list and
/// shading needs no way out (LightsOutputs::lists_always_fit); 0: too many lights, or tiles. In steps: buffers do not
/// change with every light that comes into view.
[[nodiscard]] constexpr std::uint32_t entries_that_fit_all(std::uint32_t local_count, std::uint32_t tiles) {
  const std::uint32_t entries = local_count > 24 ? 48 : 24;
  return local_count <= 48 && std::uint64_t{tiles} * entries / 3 * 4 <= kListBytesThatFitAll ? entries : 0;
}

/// Entries a tile gets in fixed-slot mode: rounded up to whole words. 0: as many as it needs.
[[nodiscard]] constexpr std::uint32_t fixed_slots_of(std::uint32_t knob) { return (knob + 2) / 3 * 3; }

/// List entries to make room for, a multiple of 3. With `fixed_slots` so many a tile; else what an earlier frame asked
/// for and a quarter more. It shrinks only when four times too large, so that a moving camera does not allocate all the
/// time.
[[nodiscard]] std::uint32_t list_capacity(std::uint32_t tiles, std::uint32_t fixed_slots,
                                          const LightFeedback& feedback);

/// Uploads what the searches and shading read, and declares their buffers. Fills `outputs` but for what passes write.
[[nodiscard]] Status upload_light_lists(FrameBuilder& frame, const ZBins& bins, const TileLightMasks& masks,
                                        LightsOutputs& outputs);

/// First contents of a view's LightCounters. Recorded in a pass that writes the buffer with transfer_write.
void record_counters_start(gpu::CommandList& commands, gpu::BufferHandle counters);

}  // namespace gloam
