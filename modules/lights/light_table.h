// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "modules/lights/components.h"
#include "shaders/lights/lights_shared.h"

namespace gloam {

struct PlacedLight;

/// Marks in LightTable::radius for what has no sphere.
inline constexpr float kGivesNothing = -1.0f;
inline constexpr float kDirectionalLight = -2.0f;

/// What a spot's angles mean; a point light has the default.
struct SpotShape {
  float inner_angle = 0.0f;  ///< what the rest was made from
  float outer_angle = 0.0f;
  vec2 ramp = vec2(0.0f, 1.0f);   ///< spot_ramp
  float cos_outer = -1.0f;        ///< of the half angle; -1 for a point light
  float center_per_range = 0.0f;  ///< the bound's centre: how far along the axis, a metre of range
  float radius_per_range = 1.0f;
};

/// What does not depend on where a light is looked at from.
struct LightRecord {
  shaders::LocalLight packed{};  ///< but for its position, which is the view's business
  SpotShape shape;
  float range_m = 0.0f;
  float radius_m = kGivesNothing;  ///< of the bound, or one of the marks above
  float brightness = 0.0f;         ///< candela or lux of the brightest channel
};

/// Lights prepared once a change and read by every view: a column a property where a loop runs over all of them. The spheres hold everything
/// a local light lights; world space.
struct LightTable {
  std::vector<double> x, y, z;
  std::vector<float> radius;  ///< metres, or one of the marks above
  std::vector<LightRecord> records;

  [[nodiscard]] std::size_t size() const { return radius.size(); }
  void resize(std::size_t count);
  void copy(std::size_t i, const LightTable& from, std::size_t j);
  /// The light itself changed; set_place must follow.
  void set_light(std::size_t i, const Light& light);
  /// The light has moved or turned.
  void set_place(std::size_t i, const PlacedLight& placed);
};

}  // namespace gloam
