// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "engine/scene/transforms.h"

namespace gloam {

/// Memory of the transform system, one row per entity with a WorldTransform. It holds what the last call has read and
/// written, so that the next one composes only what has changed since.
struct TransformTree {
  /// What a contiguous range of nodes of one archetype was composed from. Columns that the archetype lacks are empty.
  struct Inputs {
    std::vector<LocalMatrix> matrices;
    std::vector<LocalTransform> poses;
    std::vector<WorldTransform> placed;  ///< roots without a pose, which the host places
    std::vector<Parent> parents;
    std::size_t rows = 0;
  };
  std::vector<Inputs> chunks;  ///< none: nothing was composed yet
  std::vector<Entity> entities;
  std::vector<std::uint32_t> row_of_index;  ///< by Entity::index; valid only if entities[row] is that entity
  std::vector<std::uint32_t> parents;
  std::vector<std::uint32_t> depths;
  std::vector<dmat4> matrices;         ///< world matrices
  std::vector<std::uint8_t> outdated;  ///< whether the row's matrix must be composed; valid only within a call
  TransformLevels levels;
  Tick seen = 0;  ///< changes of WorldTransform up to here are the system's own, or are repaired
};

/// Adds the resources of the scene systems (SceneNodes, AnimationBindings, TransformTree, CameraPoses) to the world.
void prepare_scene_systems(World& world);

}  // namespace gloam
