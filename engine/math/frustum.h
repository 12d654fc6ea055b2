// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "engine/math/bounds.h"

namespace gloam {

/// Plane: a point p is inside if dot(normal, p) + distance ≥ 0. Normals are unit length.
struct Plane {
  vec3 normal = vec3(0.0f);
  float distance = 0.0f;
};

/// Convex region of a perspective or orthographic view, in the source space of its clip matrix. Planes: left, right,
/// bottom, top, near, far. An infinite far plane has normal 0 and distance +1 (every point is inside).
struct Frustum {
  std::array<Plane, 6> planes;
};

/// Reversed-Z, zero-to-one depth, infinite far plane: depth = near / view depth. Y up in clip space (negative viewport
/// height). fov_y in radians (0, π), aspect = width / height > 0, near_m > 0.
[[nodiscard]] mat4 reversed_perspective(float fov_y, float aspect, float near_m);

/// Reversed-Z orthographic: depth 1 at near_m, 0 at far_m.
[[nodiscard]] mat4 reversed_orthographic(float half_width_m, float half_height_m, float near_m, float far_m);

/// Frustum of a reversed-Z clip matrix, in the space that the matrix maps from.
[[nodiscard]] Frustum frustum_from_clip(const mat4& clip_from_space);

/// Conservative: false only if the volume is certainly outside. A volume with NaN is never outside. An empty box is
/// outside.
[[nodiscard]] bool may_intersect(const Frustum& frustum, const Sphere& sphere);
[[nodiscard]] bool may_intersect(const Frustum& frustum, const Aabb& box);

}  // namespace gloam
