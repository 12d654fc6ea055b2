// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "engine/scene/gltf/import.h"

namespace gloam {

/// A point of a camera path: the camera's position and a point that it looks at, in metres.
struct PathKey {
  dvec3 eye;
  dvec3 target;
};

/// A path through all cameras of a scene, in their order. The cameras must have WorldTransforms.
[[nodiscard]] std::vector<PathKey> path_through_cameras(const World& world, const SceneInfo& info);

/// world_from_camera at frame `frame` of `frames` on the closed, smooth curve (Catmull-Rom) through the keys; at least
/// one key.
[[nodiscard]] dmat4 path_pose(std::span<const PathKey> keys, std::size_t frame, std::size_t frames);

}  // namespace gloam
