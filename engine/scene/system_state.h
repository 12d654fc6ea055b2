// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "engine/scene/transforms.h"

namespace gloam {

/// Memory of the transform system, one row per entity with a WorldTransform. It is kept to save allocations; its
/// content is valid only within a call.
struct TransformTree {
  std::vector<Entity> entities;
  std::vector<std::uint32_t> row_of_index;  ///< by Entity::index; valid only if entities[row] is that entity
  std::vector<std::uint32_t> parents;
  std::vector<std::uint32_t> depths;
  std::vector<dmat4> matrices;
  TransformLevels levels;
};

/// Adds the resources of the scene systems (SceneNodes, AnimationBindings, TransformTree, CameraPoses) to the world.
void prepare_scene_systems(World& world);

}  // namespace gloam
