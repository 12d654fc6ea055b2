// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include "engine/ecs/world.h"

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

}  // namespace gloam
