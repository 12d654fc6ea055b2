// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "engine/ecs/entity.h"
#include "engine/math/types.h"

namespace gloam {

/// The rotation and translation of a node's world matrix, which may also scale, mirror or shear. The view direction is
/// that of the third column; a mirrored node keeps its second and third columns. A node that is flat along one axis
/// still has a pose, because two columns give the third. Empty if fewer than two columns have a length and differ in
/// direction, or if the position is not finite.
[[nodiscard]] std::optional<dmat4> rigid_pose(const dmat4& world_from_node);

/// World resource: the last rigid pose of each camera, for frames in which its node has none (a scale of 0). The system
/// "camera_poses" keeps it up to date.
struct CameraPoses {
  struct Row {
    Entity camera;
    dmat4 world_from_camera = dmat4(1.0);
  };
  std::vector<Row> rows;  ///< ordered by camera.index

  /// Null if the camera never had a rigid pose.
  [[nodiscard]] const dmat4* find(Entity camera) const;
};

}  // namespace gloam
