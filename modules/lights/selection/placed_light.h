// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "modules/lights/components.h"

namespace gloam {

/// A light at its place in the world: two lines of the cache, one to see whether the light has changed, one whether its
/// node has.
struct alignas(64) PlacedLight {
  Entity entity;
  Light light;
  dvec3 position = dvec3(0.0);
  vec3 direction = vec3(0.0f, 0.0f, -1.0f);  ///< where it shines, unit
  dvec3 node_z = dvec3(0.0);                 ///< the node's third column, from which the direction was made
};

/// The same for nodes whose squares are no doubles, or that have no size: −Z then.
[[nodiscard]] vec3 unusual_light_direction(const dvec3& node_z);

/// Where a node's light shines, given the node's third column.
[[nodiscard]] inline vec3 light_direction(const dvec3& node_z) {
  const double squared = glm::dot(node_z, node_z);
  if (squared > 1e-200 && squared < 1e200) return vec3(node_z * (-1.0 / std::sqrt(squared)));
  return unusual_light_direction(node_z);
}

}  // namespace gloam
