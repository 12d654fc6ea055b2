// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "engine/ecs/view.h"
#include "engine/math/finite.h"
#include "engine/scene/components.h"
#include "modules/shadows/components.h"
#include "modules/shadows/views/bulbs.h"

namespace gloam {
namespace {

constexpr double kMostColor = 1e20;  // as in the table of lights that frames use
constexpr double kRightAngle = 1.57079632679489661923;

bool gives_light(const Light& light) {
  const vec3 strength = light.color * light.intensity;
  return is_finite(strength) && std::max({strength.x, strength.y, strength.z}) > 0.0f;
}

TwinLight twin_of(const Light& light, const dmat4& world_from_node, const dvec3& origin) {
  TwinLight twin;
  twin.kind = light.kind;
  twin.position = dvec3(world_from_node[3]) - origin;
  const dvec3 node_z(world_from_node[2]);
  if (glm::length(node_z) > 0.0) twin.axis = -glm::normalize(node_z);
  twin.color = glm::clamp(dvec3(light.color) * static_cast<double>(light.intensity), 0.0, kMostColor);
  const double range = effective_range(light);
  twin.range2 = range * range;
  if (light.kind == LightKind::spot) {
    const double outer = std::cos(std::clamp(static_cast<double>(light.outer_angle), 0.0, kRightAngle));
    twin.spot_scale = 1.0 / std::max(1e-3, std::cos(static_cast<double>(light.inner_angle)) - outer);
    twin.spot_offset = -outer * twin.spot_scale;
  }
  twin.radius = light.kind == LightKind::directional ? std::tan(0.5 * static_cast<double>(light.apparent_angle))
                                                     : 0.5 * static_cast<double>(light.width_m);
  twin.bulb_radius_m = bulb_radius(light);
  if (!(twin.radius > 0.0) || !std::isfinite(twin.radius)) twin.radius = 0.0;
  return twin;
}

/// The meshes that are bulbs of a lamp.
std::vector<std::uint32_t> bulbs_of(const TwinLight& light, const SceneTracer& tracer) {
  std::vector<std::uint32_t> bulbs;
  if (light.kind == LightKind::directional) return bulbs;
  for (const EmissiveMesh& mesh : tracer.emissive_meshes())
    if (is_bulb(light.position + tracer.origin(), light.bulb_radius_m, mesh.min, mesh.max, mesh.half_diagonal_m))
      bulbs.push_back(mesh.mesh);
  return bulbs;
}

/// Maps the unit square to the unit disc, preserving ratios of areas (Shirley and Chiu 1997).
glm::dvec2 in_disc(double x, double y) {
  const double a = 2.0 * x - 1.0, b = 2.0 * y - 1.0;
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b;
  if (radius == 0.0) return glm::dvec2(0.0);
  const double angle = wide ? 0.5 * kRightAngle * b / a : kRightAngle - 0.5 * kRightAngle * a / b;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

TwinLights gather_lights(const World& world, const SceneTracer& tracer) {
  struct Found {
    std::uint32_t entity;
    TwinLight light;
  };
  std::vector<Found> found;
  world.view<const Light, const WorldTransform, Maybe<const ShadowCaster>>().each(
      [&](Entity entity, const Light& light, const WorldTransform& transform, const ShadowCaster* caster) {
        if (!gives_light(light)) return;
        TwinLight twin = twin_of(light, transform.matrix, tracer.origin());
        if (!is_finite(twin.position) || !is_finite(twin.axis)) return;
        twin.entity = entity;
        twin.casts = caster == nullptr || caster->enabled;
        found.push_back({entity.index, twin});
      });
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.entity < b.entity; });
  TwinLights result;
  std::map<std::vector<std::uint32_t>, std::uint32_t> sets = {{{}, 0}};
  result.bulbs.emplace_back();
  for (Found& one : found) {
    const std::vector<std::uint32_t> bulbs = bulbs_of(one.light, tracer);
    const auto [set, added] = sets.emplace(bulbs, static_cast<std::uint32_t>(result.bulbs.size()));
    if (added) result.bulbs.push_back(bulbs);
    one.light.bulbs = set->second;
    result.lights.push_back(one.light);
  }
  return result;
}

dvec3 illuminance_of(const TwinLight& light, const dvec3& point, dvec3& to_light) {
  if (light.kind == LightKind::directional) {
    to_light = -light.axis;
    return light.color;
  }
  const dvec3 offset = light.position - point;
  const double d2 = std::max(glm::dot(offset, offset), 1e-30);
  if (d2 >= light.range2) return dvec3(0.0);
  to_light = offset / std::sqrt(d2);
  const double cone = std::clamp(-glm::dot(to_light, light.axis) * light.spot_scale + light.spot_offset, 0.0, 1.0);
  return light.color * (range_window(d2 / light.range2) * cone * cone / d2);
}

float ray_end(double distance, double from_origin) {
  return static_cast<float>(1.0 - kRayRounding * (1.0 + from_origin / distance));
}

bool aim_at_emitter(const TwinLight& light, const dvec3& start, double x, double y, ShadowRay& ray) {
  const bool local = light.kind != LightKind::directional;
  const dvec3 middle = local ? light.position - start : -light.axis;
  const double distance = glm::length(middle);
  if (local && !(distance > kRayRounding * glm::length(start))) return false;
  dvec3 to = middle;
  if (light.radius > 0.0) {
    // The emitter faces the point: it is a disc that looks the same from everywhere.
    const dvec3 d = middle / distance;
    const dvec3 helper = std::abs(d.x) < 0.6 ? dvec3(1.0, 0.0, 0.0) : dvec3(0.0, 1.0, 0.0);
    const dvec3 u = glm::normalize(glm::cross(helper, d));
    const glm::dvec2 at = light.radius * in_disc(x, y);
    to += at.x * u + at.y * glm::cross(d, u);
  }
  ray = {.origin = vec3(start),
         .direction = vec3(to),
         .from = 0.0f,
         .to = local ? ray_end(distance, glm::length(start)) : std::numeric_limits<float>::infinity()};
  return true;
}

void BulbRays::clear() {
  rays_.clear();
  bulbs_.clear();
}

void BulbRays::add(const ShadowRay& ray, std::uint32_t bulbs) {
  rays_.push_back(ray);
  bulbs_.push_back(bulbs);
}

std::span<const std::uint8_t> BulbRays::blocked(const TwinLights& lights, const SceneTracer& tracer) {
  blocked_.resize(rays_.size());
  for (std::uint32_t set = 0; set < lights.bulbs.size(); ++set) {
    batch_.clear();
    batch_from_.clear();
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      if (bulbs_[i] != set) continue;
      batch_.push_back(rays_[i]);
      batch_from_.push_back(i);
    }
    if (batch_.empty()) continue;
    batch_blocked_.resize(batch_.size());
    tracer.occluded(batch_, batch_blocked_, lights.bulbs[set]);
    for (std::size_t i = 0; i < batch_.size(); ++i) blocked_[batch_from_[i]] = batch_blocked_[i];
  }
  return blocked_;
}

}  // namespace gloam
