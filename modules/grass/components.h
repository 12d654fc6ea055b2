// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"

namespace gloam {

/// Grass grows on the upward-facing triangles of the entity's mesh.
struct GrassSurface {
  float density = 0.0f;  ///< blades/m²
  std::uint32_t seed = 1;
  vec2 height_m = vec2(0.3f, 0.06f);  ///< mean, deviation
  float width_m = 0.006f;
  float max_distance_m = 40.0f;  ///< quantisation range of the LOD
  std::uint32_t types = 0;       ///< blade file in SceneStrings; 0: the built-in five types
};

enum class ColliderShape : std::uint8_t { none, sphere, capsule, box };

/// An obstacle that moves grass; follows the node's animation. A capsule's height includes its caps and starts at the
/// node's origin, along +Y.
struct Collider {
  ColliderShape shape = ColliderShape::none;
  float radius_m = 0.5f;
  float height_m = 1.8f;
  vec3 size_m = vec3(1.0f);
};

/// Wind; at most one per scene.
struct Wind {
  vec3 velocity = vec3(0.0f);  ///< m/s
  float gust = 0.3f;           ///< 0…1
};

}  // namespace gloam
