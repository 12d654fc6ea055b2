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

/// Marks in LightTable::radius for what has no sphere.
inline constexpr float kGivesNothing = -1.0f;
inline constexpr float kDirectionalLight = -2.0f;

/// What does not depend on where a light is looked at from; a line of the cache, because views read them in the order
/// of depths.
struct alignas(64) LightRecord {
  vec3 color = vec3(0.0f);  ///< as in LocalLight or DirectionalLight
  float inverse_range_squared = 1.0f;
  vec2 ramp = vec2(0.0f, 1.0f);  ///< spot_ramp
  float cos_outer = -1.0f;       ///< spot: of its half angle; -1 for a point light
  float range_m = 0.0f;
  float brightness = 0.0f;   ///< candela or lux of the brightest channel
  float inner_angle = 0.0f;  ///< spot: what ramp, cosine and the two below were made from
  float outer_angle = 0.0f;
  float center_per_range = 0.0f;  ///< the bound's centre: how far along the axis, a metre of range
  float radius_per_range = 1.0f;
  Entity entity;
};

/// Lights prepared once a change and read by every view: a column a property where a loop runs over all of them. The
/// spheres hold everything a local light lights; world space.
struct LightTable {
  std::vector<double> x, y, z;
  std::vector<float> radius;  ///< metres, or one of the marks above
  std::vector<float> along;   ///< metres from the light to the sphere's centre
  std::vector<LightRecord> records;

  [[nodiscard]] std::size_t size() const { return radius.size(); }
  void resize(std::size_t count);
  void copy(std::size_t i, const LightTable& from, std::size_t j);
  /// The light itself changed; set_place must follow.
  void set_light(std::size_t i, const PlacedLight& placed);
  /// The light has moved or turned.
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
