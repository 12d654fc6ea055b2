// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"
#include "engine/math/types.h"

namespace gloam {

/// What a unit of length is, for physics; a resource of the world, set by key gloam.scale. Without it a unit is a
/// metre. Positions, sizes and ranges are in units. Candela, fog density, wind and focus are per metre or in metres in
/// files, and per unit or in units in components: the importer converts them.
struct SceneUnits {
  double metres_per_unit = 1.0;  ///< > 0
};

[[nodiscard]] inline double metres_per_unit(const World& world) {
  const auto* units = world.try_resource<SceneUnits>();
  return units == nullptr ? 1.0 : units->metres_per_unit;
}

/// World in metres from node, of the same matrix in units. The same matrix if a unit is a metre.
[[nodiscard]] inline dmat4 metric_matrix(dmat4 world_from_node, double metres_per_unit) {
  for (int column = 0; column < 4; ++column)
    world_from_node[column] = dvec4(dvec3(world_from_node[column]) * metres_per_unit, world_from_node[column].w);
  return world_from_node;
}

}  // namespace gloam
