// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/harness/camera_path.h"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/scene/components.h"
#include "sandbox/scenes/construction/scene_builder.h"

namespace gloam {
namespace {

constexpr double kTargetDistance_m = 6.0;

}  // namespace

std::vector<PathKey> path_through_cameras(const World& world, const SceneInfo& info) {
  std::vector<PathKey> keys;
  for (const Entity camera : info.cameras) {
    const dmat4& pose = world.get<WorldTransform>(camera).matrix;
    const dvec3 eye(pose[3]);
    keys.push_back({eye, eye - kTargetDistance_m * glm::normalize(dvec3(pose[2]))});
  }
  return keys;
}

dmat4 path_pose(std::span<const PathKey> keys, std::size_t frame, std::size_t frames) {
  const double along = static_cast<double>(frame) * static_cast<double>(keys.size()) / static_cast<double>(frames);
  const auto segment = static_cast<std::size_t>(along);
  const double t = along - static_cast<double>(segment);
  const auto key = [&](std::size_t offset) { return keys[(segment + keys.size() + offset - 1) % keys.size()]; };
  const auto smooth = [t](const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d) {
    return 0.5 * (2.0 * b + (c - a) * t + (2.0 * a - 5.0 * b + 4.0 * c - d) * t * t +
                  (3.0 * b - a - 3.0 * c + d) * t * t * t);
  };
  const dvec3 eye = smooth(key(0).eye, key(1).eye, key(2).eye, key(3).eye);
  const dvec3 target = smooth(key(0).target, key(1).target, key(2).target, key(3).target);
  return glm::translate(dmat4(1.0), eye) * glm::mat4_cast(rotation_towards(target - eye));
}

}  // namespace gloam
