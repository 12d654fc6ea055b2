// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace gloam
