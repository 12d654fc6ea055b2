// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "engine/ecs/entity.h"
#include "modules/lights/selection/placed_light.h"
#include "shaders/lights/lights_shared.h"

namespace gloam {

/// Special values of LightTable::radius for lights without a sphere.
inline constexpr float kGivesNothing = -1.0f;
inline constexpr float kDirectionalLight = -2.0f;

/// View-independent properties of a light. One cache line, because views read the records in depth order.
struct alignas(64) LightRecord {
  vec3 color = vec3(0.0f);  ///< as in LocalLight or DirectionalLight
  float inverse_range_squared = 1.0f;
  vec2 ramp = vec2(0.0f, 1.0f);  ///< spot_ramp
  float cos_outer = -1.0f;       ///< cosine of the spot's half angle; -1 for a point light
  float range_m = 0.0f;
  float brightness = 0.0f;   ///< candela or lux of the brightest channel
  float inner_angle = 0.0f;  ///< spot: the two angles from which ramp, cos_outer and …_per_range were computed
  float outer_angle = 0.0f;
  float center_per_range = 0.0f;  ///< distance along the axis to the centre of the bound, per metre of range
  float radius_per_range = 1.0f;  ///< radius of the bound per metre of range
  float emitter_radius_m = 0.0f;  ///< half of Light::width_m; directional: half of Light::apparent_angle, in radians
  Entity entity;
};

/// Prepared light data that all views read; updated once per change. Properties that a loop reads for all lights are
/// separate arrays. The spheres enclose everything a local light lights; world space.
struct LightTable {
  std::vector<double> x, y, z;
  std::vector<float> radius;  ///< metres, or one of the special values above
  std::vector<float> along;   ///< metres from the light to the sphere's centre
  std::vector<LightRecord> records;

  [[nodiscard]] std::size_t size() const { return radius.size(); }
  void resize(std::size_t count);
  void copy(std::size_t i, const LightTable& from, std::size_t j);
  /// Call when the light itself changed; set_place must follow.
  void set_light(std::size_t i, const PlacedLight& placed);
  /// Call when the light moved or turned.
  void set_place(std::size_t i, const PlacedLight& placed) {
    const vec3& direction = placed.direction;
    if (!std::isfinite(direction.x + direction.y + direction.z)) radius[i] = kGivesNothing;
    const double reach = along[i];
    x[i] = placed.position.x + reach * static_cast<double>(direction.x);
    y[i] = placed.position.y + reach * static_cast<double>(direction.y);
    z[i] = placed.position.z + reach * static_cast<double>(direction.z);
  }
};

}  // namespace gloam
