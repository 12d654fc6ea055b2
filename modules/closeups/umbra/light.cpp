// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/umbra/light.h"

#include <algorithm>
#include <cmath>

#include "engine/math/finite.h"

namespace gloam {
namespace {

constexpr float kNarrowestCone = kPi / 180.0f;  // half angle in radians; the same limit as for standard maps
constexpr float kWidestDisc = 3.0f;             // apparent diameter in radians; the same limit

/// The unit vector of v; zero if v is zero or not finite.
dvec3 unit_or_zero(const dvec3& v) {
  const double greatest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
  if (!(greatest > 0.0) || !std::isfinite(v.x + v.y + v.z)) return dvec3(0.0);
  return glm::normalize(v / greatest);
}

/// A unit vector perpendicular to the unit vector `forward`: the direction of `wish` projected to that plane, or any
/// direction if `wish` is parallel to `forward`.
dvec3 across(const dvec3& wish, const dvec3& forward) {
  const dvec3 part = wish - forward * glm::dot(wish, forward);
  if (glm::dot(part, part) > 1e-12) return glm::normalize(part);
  const dvec3 other = std::abs(forward.x) < 0.6 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
  return glm::normalize(glm::cross(forward, other));
}

}  // namespace

std::optional<CloseupLight> closeup_light(const Light& light, const dmat4& world_from_node) {
  CloseupLight placed;
  placed.kind = light.kind;
  placed.position = dvec3(world_from_node[3]);
  if (light.kind != LightKind::directional && !is_finite(placed.position)) return std::nullopt;
  const dvec3 forward = -unit_or_zero(dvec3(world_from_node[2]));
  if (forward != dvec3(0.0)) placed.forward = forward;
  placed.right = across(unit_or_zero(dvec3(world_from_node[0])), placed.forward);
  placed.up = glm::cross(placed.right, placed.forward);
  if (light.kind == LightKind::directional) {
    if (!std::isfinite(light.apparent_angle)) return std::nullopt;
    placed.spread = std::tan(0.5 * static_cast<double>(std::clamp(light.apparent_angle, 0.0f, kWidestDisc)));
    return placed;
  }
  if (light.kind == LightKind::spot) {
    if (!std::isfinite(light.outer_angle)) return std::nullopt;
    placed.half_angle = static_cast<double>(std::clamp(light.outer_angle, kNarrowestCone, kPi * 0.5f));
  }
  placed.emitter_radius_m =
      light.width_m > 0.0f && std::isfinite(light.width_m) ? 0.5 * static_cast<double>(light.width_m) : 0.0;
  placed.range_m = static_cast<double>(effective_range(light));
  if (!std::isfinite(placed.range_m)) return std::nullopt;
  return placed;
}

}  // namespace gloam
