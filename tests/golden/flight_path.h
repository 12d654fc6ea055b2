// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/math/types.h"
#include "engine/scene/components.h"
#include "engine/scene/gltf_import.h"
#include "sandbox/scenes/scene_builder.h"

namespace gloam::test {

/// A place on a flight: where the camera is, and a point it looks at. Metres.
struct FlightKey {
  dvec3 eye;
  dvec3 target;
};

/// Through the garden of builtin:many_lights: over the whole, down among lanterns, through a standing stone, along the ground, up to
/// nothing but sky, straight down, and through glass back to the start.
inline constexpr FlightKey kManyLightsFlight[] = {
    {{-32.0, 9.8, -17.0}, {4.0, 0.4, 2.0}},   {{-20.0, 4.0, -11.0}, {-6.0, 1.0, -4.0}},
    {{-11.0, 2.0, -6.0}, {2.0, 1.4, 1.0}},    {{-4.0, 0.9, -1.0}, {6.0, 1.0, 6.0}},
    {{3.0, 0.7, 4.0}, {14.0, 1.0, 8.0}},      {{11.0, 1.4, 7.0}, {16.0, 3.0, -4.0}},
    {{14.0, 2.2, -2.0}, {14.5, 30.0, -3.0}},  {{9.0, 3.4, -9.0}, {0.0, 1.2, -12.0}},
    {{2.0, 8.0, -13.0}, {0.5, 0.0, -12.0}},   {{-5.0, 3.0, -14.0}, {-9.0, 0.4, -6.0}},
    {{-12.0, 1.6, -4.0}, {-12.0, 1.5, 12.0}}, {{-14.0, 2.4, 8.0}, {8.0, 1.0, 6.0}},
    {{-26.0, 6.5, 4.0}, {2.0, 0.4, -2.0}}};

/// A flight through all cameras of a scene, in their order.
inline std::vector<FlightKey> camera_flight(const World& world, const SceneInfo& info) {
  std::vector<FlightKey> keys;
  for (const Entity camera : info.cameras) {
    const dmat4& pose = world.get<WorldTransform>(camera).matrix;
    const dvec3 eye(pose[3]);
    keys.push_back({eye, eye - 6.0 * glm::normalize(dvec3(pose[2]))});
  }
  return keys;
}

/// The camera at frame `frame` of `frames` on the closed, smooth (Catmull-Rom) curve through the keys; at least one key.
inline dmat4 flight_pose(std::span<const FlightKey> keys, std::size_t frame, std::size_t frames) {
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

}  // namespace gloam::test
