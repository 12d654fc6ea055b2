// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/render/knobs/knob_table.h"

namespace gloam {

/// Values of the module's knobs.
struct DofKnobs {
  /// Workgroup memory of the blur (dof.cache).
  enum class Cache : std::uint8_t { device, none, vectors, channels };
  [[nodiscard]] friend constexpr std::string_view name_of(Cache cache) {
    switch (cache) {
      case Cache::device:
        return "device";
      case Cache::none:
        return "none";
      case Cache::vectors:
        return "vec4";
      case Cache::channels:
        return "channels";
    }
    return {};
  }
  Cache cache = Cache::device;
  float radius = 15.0f;          ///< of circles that are not counted as coarser, pixels of a picture of 360 lines
  bool full_resolution = false;  ///< dof.resolution
};

/// The form that a device runs. threads_in_turn: of gpu::DeviceInfo.
[[nodiscard]] constexpr DofKnobs::Cache dof_cache(DofKnobs::Cache chosen, bool threads_in_turn) {
  if (chosen != DofKnobs::Cache::device) return chosen;
  return threads_in_turn ? DofKnobs::Cache::none : DofKnobs::Cache::channels;
}

inline constexpr EnumKnob<DofKnobs::Cache> kDofCache{
    .name = "dof.cache",
    .meaning =
        "workgroup memory of the blur: not used (none), one array of vectors (vec4), one array for each channel "
        "(channels), or what is faster on this kind of device (device); the picture is the same to the bit",
    .exact = DofKnobs::Cache::none};
inline constexpr NumberKnob kDofRadius{
    .name = "dof.radius",
    .meaning =
        "limit of the radius of a circle of confusion, in pixels of a picture of 360 lines; circles beyond it "
        "are counted, are blurred at coarser levels, and stop at four times it",
    .min = 3,
    .max = 31,
    .default_value = 15,
    .unit = "pixels",
    .ledger_values = {3, 7, 15, 23, 31}};
inline constexpr ChoiceKnob<bool> kDofFullResolution{
    .name = "dof.resolution",
    .meaning =
        "size of the images that are blurred, relative to the picture, from circles of 2 (half) or 4 (full) "
        "pixels on; smaller ones mix with the sharp picture (half) or are blurred pixel by pixel (full), and wider "
        "ones are blurred in smaller images",
    .choices = {{"half", false}, {"full", true}}};

void add_dof_knobs(KnobRegistry& registry);
[[nodiscard]] DofKnobs dof_knobs(const KnobRegistry& registry);

}  // namespace gloam
