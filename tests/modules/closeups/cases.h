// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <optional>
#include <random>

#include "engine/render/packing/caster_bounds.h"
#include "engine/render/view.h"
#include "modules/closeups/umbra/light.h"

namespace gloam::test {

/// Random lights and boxes, and receivers for which a box hides part of a light: on rays from points of the emitter
/// through points of the box.
class CloseupCases {
 public:
  explicit CloseupCases(std::uint32_t seed) : random_(seed) {}

  [[nodiscard]] double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  [[nodiscard]] bool chance(double share) { return in(0.0, 1.0) < share; }
  [[nodiscard]] dvec3 point(double reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  [[nodiscard]] dvec3 direction() {
    for (;;) {
      const dvec3 v = point(1.0);
      if (const double l = glm::length(v); l > 1e-3 && l < 1.0) return v / l;
    }
  }
  [[nodiscard]] WorldBox box(const dvec3& middle, double least, double most) {
    const dvec3 half = dvec3(in(least, most), in(least, most), in(least, most)) * 0.5;
    return {middle - half, middle + half};
  }
  /// A node at `at` that looks along `forward`, with a random roll.
  [[nodiscard]] dmat4 looking(const dvec3& at, const dvec3& forward) {
    const dvec3 side = std::abs(forward.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
    const dmat4 node = glm::inverse(glm::lookAt(at, at + forward, side));
    return glm::rotate(node, in(-3.0, 3.0), dvec3(0, 0, 1));
  }
  /// A point of the box, half of the time a corner.
  [[nodiscard]] dvec3 inside(const WorldBox& b) {
    const bool corner = chance(0.5);
    dvec3 p;
    for (int c = 0; c < 3; ++c) p[c] = corner ? (chance(0.5) ? b.min[c] : b.max[c]) : in(b.min[c], b.max[c]);
    return p;
  }

  /// A receiver, and the point of the box that hides it.
  struct Hidden {
    dvec3 receiver = dvec3(0.0);
    dvec3 blocker = dvec3(0.0);
  };
  /// None for rays that leave the light's reach before the box. `share`: position along the ray, 0…1.
  [[nodiscard]] std::optional<Hidden> hidden(const CloseupLight& light, const WorldBox& subject,
                                             const WorldBox& receivers, double share) {
    const dvec3 blocker = inside(subject);
    if (light.kind == LightKind::directional) {
      dvec3 side = glm::cross(light.forward, direction());
      side = glm::length(side) > 0.0 ? glm::normalize(side) : side;
      const dvec3 ray = light.forward + side * light.spread * (chance(0.5) ? 1.0 : in(0.0, 1.0));
      const double longest = glm::length(receivers.max - receivers.min);
      dvec3 exit(longest);
      for (int c = 0; c < 3; ++c)
        if (ray[c] != 0.0) exit[c] = ((ray[c] > 0.0 ? receivers.max[c] : receivers.min[c]) - blocker[c]) / ray[c];
      const double length = std::min({exit.x, exit.y, exit.z});
      if (length < 0.0) return std::nullopt;
      return Hidden{blocker + ray * (share * length), blocker};
    }
    const dvec3 from = light.position + direction() * light.emitter_radius_m * (chance(0.5) ? 1.0 : in(0.0, 1.0));
    const dvec3 ray = blocker - from;
    const dvec3 start = blocker - light.position;
    // Solves |start + u · ray| = range.
    const double a = glm::dot(ray, ray);
    const double b = glm::dot(start, ray);
    const double c = glm::dot(start, start) - light.range_m * light.range_m;
    if (c > 0.0 || a == 0.0) return std::nullopt;
    const double end = (-b + std::sqrt(std::max(b * b - a * c, 0.0))) / a;
    const dvec3 receiver = blocker + ray * (share * end);
    if (light.kind == LightKind::spot) {
      const dvec3 to = receiver - light.position;
      if (!(glm::dot(to, light.forward) >= std::cos(light.half_angle) * glm::length(to))) return std::nullopt;
    }
    return Hidden{receiver, blocker};
  }

  /// A random receiver in a spot's cone, often at its edge; none unless the box hides part of the light from it. Needed
  /// for narrow cones, which few rays through the box stay in.
  [[nodiscard]] std::optional<Hidden> hidden_in_cone(const CloseupLight& light, const WorldBox& subject) {
    const double angle = light.half_angle * (chance(0.5) ? 0.9999 : std::sqrt(in(0.0, 1.0)));
    const double turn = in(-3.15, 3.15);
    const dvec3 side = light.right * std::cos(turn) + light.up * std::sin(turn);
    const dvec3 to = light.forward * std::cos(angle) + side * std::sin(angle);
    const dvec3 receiver = light.position + to * light.range_m * (chance(0.3) ? 1.0 : in(0.0, 1.0));
    const dvec3 from = light.position + direction() * light.emitter_radius_m * (chance(0.3) ? 0.0 : 1.0);
    double enters = 0.0;
    double leaves = 1.0;
    for (int c = 0; c < 3; ++c) {
      const double way = receiver[c] - from[c];
      const double a = (subject.min[c] - from[c]) / way;
      const double b = (subject.max[c] - from[c]) / way;
      enters = std::max(enters, std::min(a, b));
      leaves = std::min(leaves, std::max(a, b));
    }
    if (!(enters <= leaves)) return std::nullopt;
    return Hidden{receiver, from + (receiver - from) * enters};
  }

  std::mt19937 random_;
};

}  // namespace gloam::test
