// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/scene/components.h"
#include "modules/lights/components.h"
#include "modules/lights/selection/light_table.h"
#include "modules/lights/selection/placed_light.h"

namespace gloam {

/// The lights of one archetype chunk.
struct LightRows {
  std::span<const Entity> entities;
  std::span<const Light> lights;
  std::span<const WorldTransform> transforms;
  std::span<LightBounds> bounds;  ///< empty: the entities have no LightBounds yet
  std::size_t first = 0;          ///< row number of the chunk's first light
};

/// Every light of the world that has a WorldTransform, sorted by entity index; a world resource kept up to date by
/// system light_bounds.
struct LightSet {
  std::vector<PlacedLight> lights;
  LightTable table;           ///< derived data of `lights`, same order
  std::uint64_t version = 1;  ///< changes whenever anything in this struct changes
  std::uint32_t updated = 0;  ///< lights added or changed in the last run

  /// The rows of the last run, in the order of the ECS views. The spans in `chunks` are valid only during the run.
  std::vector<LightRows> chunks;
  std::vector<Entity> rows;
  std::vector<std::uint32_t> slot_of_row;  ///< index into `lights`
};

}  // namespace gloam
