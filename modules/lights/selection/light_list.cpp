// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/selection/light_list.h"

#include <algorithm>
#include <cmath>

#include "engine/math/finite.h"

namespace gloam {
namespace {

constexpr float kLeastRange = 1e-15f;  // its square and the inverse of that fit a float
constexpr float kMostRange = 1e9f;     // metres: its square fits a float
constexpr float kHalfPi = kPi * 0.5f;

float brightness(const Light& light) {
  return light.intensity * std::max({light.color.r, light.color.g, light.color.b, 0.0f});
}

/// Half angle, clamped to π/2 (a cone of 180°).
float outer_angle(const Light& light) { return std::clamp(light.outer_angle, 0.0f, kHalfPi); }

}  // namespace

float effective_range(const Light& light) {
  const float range =
      light.range_m > 0.0f ? light.range_m : std::sqrt(std::max(brightness(light), 0.0f) / light.unseen_lux);
  return std::min(std::max(kLeastRange, range), kMostRange);  // this argument order turns NaN into kLeastRange
}

vec3 unusual_light_direction(const dvec3& node_z) {
  const double greatest = std::max({std::abs(node_z.x), std::abs(node_z.y), std::abs(node_z.z)});
  return is_finite(node_z) && greatest > 0.0 ? vec3(glm::normalize(-node_z / greatest)) : vec3(0.0f, 0.0f, -1.0f);
}

PlacedLight place_light(Entity entity, const Light& light, const dmat4& world_from_node) {
  const dvec3 node_z(world_from_node[2]);
  return {entity, light, dvec3(world_from_node[3]), light_direction(node_z), node_z};
}

Sphere light_bounds(const PlacedLight& light, const dvec3& origin) {
  const vec3 position = vec3(light.position - origin);
  const float range = effective_range(light.light);
  if (light.light.kind != LightKind::spot) return {position, range};
  return bounding_sphere(Cone{position, light.direction, outer_angle(light.light), range});
}

vec2 spot_ramp(const Light& light) {
  if (light.kind != LightKind::spot) return vec2(0.0f, 1.0f);
  const float cos_outer = std::cos(outer_angle(light));
  const float scale = 1.0f / std::max(1e-3f, std::cos(light.inner_angle) - cos_outer);
  return vec2(scale, -cos_outer * scale);
}

}  // namespace gloam
