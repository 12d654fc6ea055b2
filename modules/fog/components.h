// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"

namespace gloam {

/// Homogeneous fog; at most one per scene.
struct Fog {
  float density = 0.0f;     ///< 1/m (in worlds with SceneUnits: per unit)
  vec3 color = vec3(0.0f);  ///< in-scattered radiance, cd/m²
  /// Longest path through the fog, also that of sky pixels. Fog lies near the ground, so the sky is dimmed but visible.
  float sky_distance_m = 200.0f;
};

}  // namespace gloam
