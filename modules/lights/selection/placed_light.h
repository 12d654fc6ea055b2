// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"
#include "modules/lights/components.h"

namespace gloam {

/// A light with its place in the world. Two cache lines: one is read to detect a changed light, the other a changed
/// node.
struct alignas(64) PlacedLight {
  Entity entity;
  Light light;
  dvec3 position = dvec3(0.0);
  vec3 direction = vec3(0.0f, 0.0f, -1.0f);  ///< direction in which it shines, unit length
  dvec3 node_z = dvec3(0.0);                 ///< the node's third column, from which `direction` was computed
};

/// light_direction for a node whose squared length is too small or too large for a double. −Z if the node has no size
/// or is not finite.
[[nodiscard]] vec3 unusual_light_direction(const dvec3& node_z);

/// The direction in which a node's light shines. `node_z`: the third column of the node's matrix.
[[nodiscard]] inline vec3 light_direction(const dvec3& node_z) {
  const double squared = glm::dot(node_z, node_z);
  if (squared > 1e-200 && squared < 1e200) return vec3(node_z * (-1.0 / std::sqrt(squared)));
  return unusual_light_direction(node_z);
}

}  // namespace gloam
