// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// The surface of revolution of a smooth curve through the points (radius, height) about +Y, from bottom to top, at
/// least 2 points, radii ≥ 0. Normals are smooth. sides ≥ 3.
[[nodiscard]] Primitive rounded_shape(std::span<const vec2> outline, std::uint32_t sides);

/// A tube along a line of at least 2 points, with one radius for each point, and flat ends. sides ≥ 3.
[[nodiscard]] Primitive tube_shape(std::span<const vec3> line, std::span<const float> radii, std::uint32_t sides);

/// A saddle roof: the ridge along x at height_m above the middle of a rectangle of size_m (x, z) at y = 0.
[[nodiscard]] Primitive roof_shape(vec2 size_m, float height_m);

/// Shapes of many colours that are drawn as one mesh: each part is coloured by its vertices.
class Model {
 public:
  /// color: linear RGB, multiplied with the material's base colour and with the part's own colours. pose: invertible.
  void add(const Primitive& part, vec3 color, const mat4& pose = mat4(1.0f));
  void add(const Primitive& part, vec3 color, vec3 offset_m);
  /// A box between two corners.
  void box(vec3 color, vec3 min, vec3 max);
  void tube(vec3 color, std::span<const vec3> line, std::span<const float> radii, std::uint32_t sides);
  /// A ball stretched to these half axes.
  void ball(vec3 color, vec3 center, vec3 half_axes, std::uint32_t sides);
  /// A flat quad with corners counter-clockwise as seen from its front.
  void quad(vec3 color, vec3 a, vec3 b, vec3 c, vec3 d);

  [[nodiscard]] const Primitive& shape() const { return shape_; }

 private:
  Primitive shape_;
};

/// A number in 0…1 for a pair of numbers, always the same.
[[nodiscard]] float dusk_scatter(std::uint32_t a, std::uint32_t b);

}  // namespace gloam
