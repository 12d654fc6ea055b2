// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "engine/scene/transforms.h"

namespace gloam {

/// What the transform system keeps from frame to frame, a row an entity with a WorldTransform; meaningful only within a
/// call.
struct TransformTree {
  std::vector<Entity> entities;
  std::vector<std::uint32_t> row_of_index;  ///< by Entity::index; valid where entities[row] is that entity
  std::vector<std::uint32_t> parents;
  std::vector<std::uint32_t> depths;
  std::vector<dmat4> matrices;
  TransformLevels levels;
};

/// Puts the systems' own resources (SceneNodes, AnimationBindings, TransformTree) into the world.
void prepare_scene_systems(World& world);

}  // namespace gloam
