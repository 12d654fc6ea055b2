// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/render/knobs/knobs.h"

namespace gloam {

/// Values of the module's knobs.
struct DofKnobs {
  /// Workgroup memory of the blur (dof.cache).
  enum class Cache : std::uint8_t { none, vectors, channels };
  Cache cache = Cache::none;
  float radius = 15.0f;          ///< greatest radius of a circle of confusion, pixels of the picture
  bool full_resolution = false;  ///< dof.resolution

  [[nodiscard]] std::uint32_t scale() const { return full_resolution ? 1 : 2; }  ///< pixels a texel of the layers
};

void add_dof_knobs(KnobRegistry& registry);
[[nodiscard]] DofKnobs dof_knobs(const KnobRegistry& registry);

}  // namespace gloam
