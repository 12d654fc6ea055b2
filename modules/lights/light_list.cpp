// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/light_list.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

constexpr float kLeastIlluminance = 0.01f;  // lux: where a light without a range ends
constexpr float kLeastRange = 1e-3f;        // metres
constexpr float kMostRange = 1e9f;          // metres: its square is a float
constexpr float kMostColor = 1e20f;         // candela or lux: what shading makes of it is a float
constexpr float kHalfPi = kPi * 0.5f;

struct Candidate {
  std::uint32_t light = 0;
  float near_depth = 0.0f;
  float importance = 0.0f;
};

float brightness(const Light& light) {
  return light.intensity * std::max({light.color.r, light.color.g, light.color.b, 0.0f});
}

/// Colour times intensity, free of negative channels and of values that shading could not multiply.
vec3 strength(const Light& light) { return glm::clamp(light.color * light.intensity, vec3(0.0f), vec3(kMostColor)); }

bool is_finite(const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// False for lights that give nothing, and for those with NaN or infinity where no sense can be made of it.
bool shines(const PlacedLight& placed, const RenderView& view) {
  const Light& light = placed.light;
  if (!is_finite(light.color) || !std::isfinite(light.intensity) || !(brightness(light) > 0.0f)) return false;
  if (!is_finite(placed.direction)) return false;
  if (light.kind == LightKind::directional) return std::isfinite(light.apparent_angle);
  if (light.kind == LightKind::spot && !(std::isfinite(light.inner_angle) && std::isfinite(light.outer_angle))) return false;
  return is_finite(view.relative(placed.position));
}

/// Cones over 180° are cut to it.
float outer_angle(const Light& light) { return std::clamp(light.outer_angle, 0.0f, kHalfPi); }

shaders::LocalLight pack_local(const PlacedLight& placed, const RenderView& view) {
  shaders::LocalLight packed{};
  const float range = effective_range(placed.light);
  packed.position = view.relative(placed.position);
  packed.inverse_range_squared = 1.0f / (range * range);
  packed.color = strength(placed.light);
  packed.direction = placed.direction;
  const vec2 ramp = spot_ramp(placed.light);
  packed.spot_scale = ramp.x;
  packed.spot_offset = ramp.y;
  return packed;
}

/// Keeps the `capacity` most important candidates; returns how many were dropped.
std::uint32_t keep_most_important(std::vector<Candidate>& candidates, std::size_t capacity) {
  if (candidates.size() <= capacity) return 0;
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return a.importance != b.importance ? a.importance > b.importance : a.light < b.light;
  });
  const auto dropped = static_cast<std::uint32_t>(candidates.size() - capacity);
  candidates.resize(capacity);
  return dropped;
}

}  // namespace

float effective_range(const Light& light) {
  const float range = light.range_m > 0.0f ? light.range_m : std::sqrt(std::max(brightness(light), 0.0f) / kLeastIlluminance);
  return std::min(std::max(kLeastRange, range), kMostRange);  // in this order NaN gives the least
}

PlacedLight place_light(Entity entity, const Light& light, const dmat4& world_from_node) {
  PlacedLight placed{entity, light, dvec3(world_from_node[3]), vec3(0.0f, 0.0f, -1.0f)};
  const dvec3 axis = -dvec3(world_from_node[2]);
  const double length = glm::length(axis);
  if (length > 0.0 && std::isfinite(length)) placed.direction = vec3(axis / length);
  return placed;
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

void select_lights(std::span<const PlacedLight> lights, const RenderView& view, VisibleLights& visible) {
  visible.local_entities.clear();
  visible.directional_entities.clear();
  visible.total = static_cast<std::uint32_t>(lights.size());
  const vec3 forward = -vec3(glm::transpose(view.view_from_relative)[2]);
  std::vector<Candidate> local;
  std::vector<Candidate> directional;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const PlacedLight& placed = lights[i];
    if (!shines(placed, view)) continue;
    if (placed.light.kind == LightKind::directional) {
      directional.push_back({i, 0.0f, std::min(brightness(placed.light), kMostColor)});
      continue;
    }
    const Sphere bounds = light_bounds(placed, view.position);
    if (!may_intersect(view.frustum, bounds)) continue;
    const float depth = glm::dot(forward, bounds.center);
    const float distance = std::max(glm::length(bounds.center), bounds.radius);
    const float coverage = bounds.radius * bounds.radius / (distance * distance);
    local.push_back({i, std::max(view.near_m, depth - bounds.radius), coverage * std::min(brightness(placed.light), kMostColor)});
  }
  visible.dropped = keep_most_important(local, GLOAM_MAX_LOCAL_LIGHTS);
  visible.dropped += keep_most_important(directional, GLOAM_MAX_DIRECTIONAL_LIGHTS);
  std::sort(directional.begin(), directional.end(), [](const Candidate& a, const Candidate& b) { return a.light < b.light; });
  std::sort(local.begin(), local.end(), [](const Candidate& a, const Candidate& b) {
    return a.near_depth != b.near_depth ? a.near_depth < b.near_depth : a.light < b.light;
  });

  shaders::LightBlock& block = visible.block;
  block.local_count = static_cast<std::uint32_t>(local.size());
  block.directional_count = static_cast<std::uint32_t>(directional.size());
  for (std::size_t i = 0; i < local.size(); ++i) {
    block.local[i] = pack_local(lights[local[i].light], view);
    visible.local_entities.push_back(lights[local[i].light].entity);
  }
  for (std::size_t i = 0; i < directional.size(); ++i) {
    const PlacedLight& placed = lights[directional[i].light];
    block.directional[i] = {strength(placed.light), placed.light.apparent_angle, placed.direction, 0.0f};
    visible.directional_entities.push_back(placed.entity);
  }
}

}  // namespace gloam
