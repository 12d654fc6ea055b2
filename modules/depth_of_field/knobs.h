// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

#include "engine/render/knobs/knob_table.h"
#include "shaders/depth_of_field/depth_of_field_shared.h"

namespace gloam {

/// Values of the module's knobs.
struct DofKnobs {
  /// Workgroup memory of the blur (dof.cache).
  enum class Cache : std::uint8_t { none, vectors, channels };
  [[nodiscard]] friend constexpr std::string_view name_of(Cache cache) {
    switch (cache) {
      case Cache::none:
        return "none";
      case Cache::vectors:
        return "vec4";
      case Cache::channels:
        return "channels";
    }
    return {};
  }
  Cache cache = Cache::none;
  float radius = 15.0f;          ///< greatest radius of a circle of confusion, pixels of the picture
  bool full_resolution = false;  ///< dof.resolution

  [[nodiscard]] std::uint32_t scale() const { return full_resolution ? 1 : 2; }  ///< pixels a texel of the layers
};

inline constexpr EnumKnob<DofKnobs::Cache> kDofCache{
    .name = "dof.cache",
    .meaning =
        "workgroup memory of the blur: not used (none), one array of vectors (vec4), or one array for each "
        "channel (channels); the picture is the same"};
inline constexpr NumberKnob kDofRadius{.name = "dof.radius",
                                       .meaning = "greatest radius of a circle of confusion, in pixels of the picture",
                                       .min = 3,
                                       .max = GLOAM_DOF_MOST_RADIUS,
                                       .default_value = 15,
                                       .unit = "pixels",
                                       .ledger_values = {3, 7, 15, 23, 31}};
inline constexpr ChoiceKnob<bool> kDofFullResolution{
    .name = "dof.resolution",
    .meaning = "size of the images that are blurred, relative to the picture",
    .choices = {{"half", false}, {"full", true}}};

void add_dof_knobs(KnobRegistry& registry);
[[nodiscard]] DofKnobs dof_knobs(const KnobRegistry& registry);

}  // namespace gloam
