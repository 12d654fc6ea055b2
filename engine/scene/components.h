// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"

namespace gloam {

/// Pose relative to the parent; the matrix is translation · rotation · scale.
struct LocalTransform {
  dvec3 translation = dvec3(0.0);
  dquat rotation = dquat(1.0, 0.0, 0.0, 0.0);
  dvec3 scale = dvec3(1.0);
};

/// Replaces the pose of LocalTransform for a node whose matrix is not T·R·S (sheared). Animation does not move the
/// node.
struct LocalMatrix {
  dmat4 matrix = dmat4(1.0);
};

/// Parent of an entity, and the entity's depth in the node tree. Roots have depth 0 and no Parent.
struct Parent {
  Entity entity;
  std::uint32_t depth = 1;
};

/// World matrix of the node, composed in double by the transform system.
struct WorldTransform {
  dmat4 matrix = dmat4(1.0);
};

/// Draws a mesh of SceneAssets at the entity's transform. `skin` kNone (~0): rigid.
struct MeshInstance {
  std::uint32_t mesh = 0;
  std::uint32_t skin = ~0u;
  bool casts_shadows = true;
};

/// Current morph weights: `count` floats from `first` in MorphWeights.
struct MorphInstance {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// Perspective (fov_y radians) or orthographic (half extents in metres) camera looking along the node's −Z.
struct Camera {
  bool orthographic = false;
  float fov_y = 0.8f;
  float half_width_m = 1.0f;
  float half_height_m = 1.0f;
  float near_m = 0.1f;
  float far_m = 0.0f;  ///< 0: infinite
};

/// glTF node index of an entity made by the importer.
struct SourceNode {
  std::uint32_t index = 0;
};

}  // namespace gloam
