// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/types.h"

namespace gloam {

/// Homogeneous fog; at most one per scene.
struct Fog {
  float density = 0.0f;     ///< 1/m
  vec3 color = vec3(0.0f);  ///< in-scattered radiance, cd/m²
};

}  // namespace gloam
