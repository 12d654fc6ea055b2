// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

#include "engine/math/types.h"

namespace gloam {

/// Axis-aligned box. The default box is empty (min > max); grow() can start from it.
struct Aabb {
  vec3 min = vec3(std::numeric_limits<float>::infinity());
  vec3 max = vec3(-std::numeric_limits<float>::infinity());

  [[nodiscard]] bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  [[nodiscard]] vec3 center() const { return (min + max) * 0.5f; }
  [[nodiscard]] vec3 half_extent() const { return (max - min) * 0.5f; }
  void grow(vec3 point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void grow(const Aabb& other) {
    if (other.empty()) return;
    grow(other.min);
    grow(other.max);
  }
};

struct Sphere {
  vec3 center = vec3(0.0f);
  float radius = 0.0f;
};

/// Solid spherical sector: apex, unit axis, half angle in radians in [0, π/2], range in metres from the apex to every
/// point of the cap.
struct Cone {
  vec3 apex = vec3(0.0f);
  vec3 axis = vec3(0.0f, 0.0f, -1.0f);
  float half_angle = 0.0f;
  float range_m = 0.0f;
};

/// Axis-aligned box of a transformed box: tight around its eight transformed corners, rounded outward. The matrix must
/// be affine. An empty box stays empty; NaN in the box or the matrix gives a box of NaN.
[[nodiscard]] Aabb transformed(const Aabb& box, const mat4& affine);

/// Smallest sphere around a solid spherical sector.
[[nodiscard]] Sphere bounding_sphere(const Cone& cone);

/// Sphere through the corners of a box; the radius is rounded up. Asserts that the box is not empty.
[[nodiscard]] Sphere bounding_sphere(const Aabb& box);

}  // namespace gloam
