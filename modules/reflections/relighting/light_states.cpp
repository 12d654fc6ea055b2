// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/relighting/light_states.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/ecs/view.h"
#include "engine/math/finite.h"
#include "engine/scene/components.h"

namespace gloam {
namespace {

constexpr double kFarAway = 6.0;  // half diagonals of a patch: from there on, its centre stands for all of it
constexpr double kMostLux = 1e30;
constexpr double kLeastSquare = 1e-12;  // m²

double squared(double x) { return x * x; }

double area_of(const LitPatch& patch) { return 4.0 * glm::length(glm::cross(patch.half_u, patch.half_v)); }

/// Share of its intensity that a light has at a distance and in a direction from it (unit length).
double share_toward(const CapturedLightState& light, double squared_distance, const dvec3& direction) {
  double share = 1.0;
  if (light.range_m > 0.0f) share = range_window(squared_distance / squared(static_cast<double>(light.range_m)));
  if (light.kind != LightKind::spot) return share;
  const double outer = std::cos(static_cast<double>(light.cone.y)), inner = std::cos(static_cast<double>(light.cone.x));
  const double cosine = glm::dot(direction, light.direction);
  return share * squared(std::clamp((cosine - outer) / std::max(inner - outer, 1e-3), 0.0, 1.0));
}

/// Solid angle of a triangle, seen from the origin (Van Oosterom and Strackee 1983).
double solid_angle(const dvec3& a, const dvec3& b, const dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double under = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return std::abs(2.0 * std::atan2(glm::dot(a, glm::cross(b, c)), under));
}

double solid_angle(const LitPatch& patch, const dvec3& eye) {
  const dvec3 center = patch.center - eye;
  const dvec3 a = center - patch.half_u - patch.half_v, b = center + patch.half_u - patch.half_v,
              c = center + patch.half_u + patch.half_v, d = center - patch.half_u + patch.half_v;
  return solid_angle(a, b, c) + solid_angle(a, c, d);
}

/// Mean of share_toward() over 3 × 3 points of a patch, each weighted by the light that reaches it.
double mean_share(const CapturedLightState& light, const LitPatch& patch) {
  if (light.kind == LightKind::point && light.range_m <= 0.0f) return 1.0;
  double sum = 0.0, weights = 0.0;
  for (int s = -1; s <= 1; ++s)
    for (int t = -1; t <= 1; ++t) {
      const dvec3 point = patch.center + 2.0 / 3.0 * (double(s) * patch.half_u + double(t) * patch.half_v);
      const dvec3 away = point - light.position;
      const double square = std::max(glm::dot(away, away), kLeastSquare), distance = std::sqrt(square);
      const double weight = std::abs(glm::dot(patch.normal, away)) / (square * distance);
      sum += weight * share_toward(light, square, away / distance);
      weights += weight;
    }
  return weights > 0.0 ? sum / weights : 0.0;
}

/// Flux through the patch, divided by intensity.
double flux(const CapturedLightState& light, const LitPatch& patch, double area) {
  if (light.kind == LightKind::directional) return area * std::max(glm::dot(patch.normal, -light.direction), 0.0);
  const dvec3 away = patch.center - light.position;
  const double before = -glm::dot(patch.normal, away);
  if (!(before > 0.0)) return 0.0;
  const double square = std::max(glm::dot(away, away), kLeastSquare);
  const double half = std::sqrt(glm::dot(patch.half_u, patch.half_u)) + std::sqrt(glm::dot(patch.half_v, patch.half_v));
  if (light.range_m > 0.0f && square > squared(static_cast<double>(light.range_m) + half)) return 0.0;
  if (square > squared(kFarAway * half)) {
    const double distance = std::sqrt(square);
    return share_toward(light, square, away / distance) * area * before / (square * distance);
  }
  return mean_share(light, patch) * solid_angle(patch, light.position);
}

}  // namespace

CapturedLightState light_state(Entity entity, const Light& light, const dmat4& world_from_node) {
  CapturedLightState state;
  state.light = entity;
  state.kind = light.kind;
  const vec3 emitted = light.color * light.intensity;
  const dvec3 position(world_from_node[3]), along(-dvec3(world_from_node[2]));
  const bool spot = light.kind == LightKind::spot, directional = light.kind == LightKind::directional;
  if (!is_finite(emitted) || !is_finite(position) || !is_finite(along) || !std::isfinite(light.range_m)) return state;
  state.emitted = glm::max(emitted, vec3(0.0f));
  if (!directional) state.position = position;
  if (!directional) state.range_m = std::max(light.range_m, 0.0f);
  if (spot || directional) state.direction = dvec3(light_direction(dvec3(world_from_node[2])));
  if (spot) {
    const float outer = std::clamp(light.outer_angle, 0.0f, 0.5f * std::numbers::pi_v<float>);
    state.cone = vec2(std::clamp(light.inner_angle, 0.0f, outer), outer);
  }
  return state;
}

std::vector<CapturedLightState> light_states(const World& world) {
  std::vector<CapturedLightState> states;
  world.view<const Light, const WorldTransform>().each(
      [&](Entity entity, const Light& light, const WorldTransform& transform) {
        states.push_back(light_state(entity, light, transform.matrix));
      });
  std::ranges::sort(states, {}, [](const CapturedLightState& state) { return state.light.index; });
  return states;
}

std::vector<LitPatch> proxy_patches(const PlacedProxy& proxy, float surface_m) {
  std::vector<LitPatch> patches;
  const double share = 1.0 / kProxyCells;
  for (std::uint32_t y = 0; y < kProxyCells; ++y)
    for (std::uint32_t x = 0; x < kProxyCells; ++x) {
      const double s = (2.0 * x + 1.0) * share - 1.0, t = 1.0 - (2.0 * y + 1.0) * share;
      patches.push_back(
          {.center = proxy.center + s * proxy.half_u + t * proxy.half_v + static_cast<double>(surface_m) * proxy.normal,
           .half_u = share * proxy.half_u,
           .half_v = share * proxy.half_v,
           .normal = proxy.normal});
    }
  return patches;
}

std::vector<LitPatch> probe_patches(const dvec3& eye, std::span<const CapturedSurface> surfaces) {
  std::vector<LitPatch> patches;
  for (const CapturedSurface& surface : surfaces) {
    LitPatch& patch = patches.emplace_back();
    const dvec3 away(surface.position);
    const double distance = glm::length(away);
    patch.center = eye + away;
    if (surface.normal == vec3(0.0f) || !(distance > 0.0)) continue;
    patch.normal = glm::normalize(dvec3(surface.normal));
    const double facing = std::max(-glm::dot(patch.normal, away) / distance, 0.1);
    const double half = distance * std::sqrt(std::numbers::pi / (kProbeCells * kProbeCells) / facing);
    const dvec3 helper = std::abs(patch.normal.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0);
    patch.half_u = half * glm::normalize(glm::cross(helper, patch.normal));
    patch.half_v = glm::cross(patch.normal, patch.half_u);
  }
  return patches;
}

double unit_illuminance(const CapturedLightState& light, const LitPatch& patch) {
  const double area = area_of(patch), mean = flux(light, patch, area) / area;
  return std::isfinite(mean) && mean > 0.0 ? mean : 0.0;
}

std::vector<vec3> illuminances(std::span<const CapturedLightState> lights, std::span<const LitPatch> patches) {
  std::vector<vec3> all;
  for (const LitPatch& patch : patches) {
    dvec3 sum(0.0);
    for (const CapturedLightState& light : lights)
      if (light.emitted != vec3(0.0f)) sum += dvec3(light.emitted) * unit_illuminance(light, patch);
    all.push_back(vec3(glm::min(sum, dvec3(kMostLux))));
  }
  return all;
}

}  // namespace gloam
