// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Planes from a clip matrix: Gribb and Hartmann, "Fast Extraction of Viewing Frustum Planes from the
// World-View-Projection Matrix" (2001). Changed for zero-to-one reversed depth: the near plane is z ≤ w, the far plane
// z ≥ 0.
#include "engine/math/frustum.h"

#include <cmath>

#include "engine/core/assert.h"

namespace gloam {
namespace {

/// Bound on the error of a point's plane distance when the plane is rounded to float, relative to the sum of the terms'
/// magnitudes.
constexpr double kRounding = 1.0 / (1 << 22);

dvec4 row_of(const mat4& m, int row) { return {m[0][row], m[1][row], m[2][row], m[3][row]}; }

Plane plane_from(dvec4 equation) {
  const double length = glm::length(dvec3(equation));
  // An infinite far plane has a zero normal, or a tiny one left by rounding.
  if (length <= 1e-12 * std::abs(equation.w)) return {vec3(0.0f), 1.0f};
  return {vec3(dvec3(equation) / length), static_cast<float>(equation.w / length)};
}

bool has_nan(vec3 v) { return std::isnan(v.x) || std::isnan(v.y) || std::isnan(v.z); }

double distance_rounding(const Plane& plane, dvec3 reach) {
  return kRounding * (glm::dot(glm::abs(dvec3(plane.normal)), reach) + std::abs(static_cast<double>(plane.distance)));
}

}  // namespace

mat4 reversed_perspective(float fov_y, float aspect, float near_m) {
  GLOAM_ASSERT(fov_y > 0.0f && fov_y < kPi, "a perspective's field of view is in (0, pi)");
  GLOAM_ASSERT(aspect > 0.0f && near_m > 0.0f, "a perspective's aspect and near distance are positive");
  const double focal = 1.0 / std::tan(0.5 * fov_y);
  mat4 m(0.0f);
  m[0][0] = static_cast<float>(focal / aspect);
  m[1][1] = static_cast<float>(focal);
  m[2][3] = -1.0f;
  m[3][2] = near_m;
  return m;
}

mat4 reversed_orthographic(float half_width_m, float half_height_m, float near_m, float far_m) {
  GLOAM_ASSERT(half_width_m > 0.0f && half_height_m > 0.0f, "an orthographic view's half extents are positive");
  GLOAM_ASSERT(near_m < far_m, "an orthographic view's near distance is below its far distance");
  const double depth = static_cast<double>(far_m) - near_m;
  mat4 m(0.0f);
  m[0][0] = 1.0f / half_width_m;
  m[1][1] = 1.0f / half_height_m;
  m[2][2] = static_cast<float>(1.0 / depth);
  m[3][2] = static_cast<float>(far_m / depth);
  m[3][3] = 1.0f;
  return m;
}

Frustum frustum_from_clip(const mat4& clip_from_space) {
  const dvec4 x = row_of(clip_from_space, 0);
  const dvec4 y = row_of(clip_from_space, 1);
  const dvec4 z = row_of(clip_from_space, 2);
  const dvec4 w = row_of(clip_from_space, 3);
  return {
      {plane_from(w + x), plane_from(w - x), plane_from(w + y), plane_from(w - y), plane_from(w - z), plane_from(z)}};
}

bool may_intersect(const Frustum& frustum, const Sphere& sphere) {
  GLOAM_ASSERT(!(sphere.radius < 0.0f), "a sphere's radius is not negative");
  const dvec3 center(sphere.center);
  const double radius = sphere.radius;
  for (const Plane& plane : frustum.planes) {
    const double distance = glm::dot(dvec3(plane.normal), center) + plane.distance;
    // Written so that NaN counts as inside.
    if (distance < -radius - distance_rounding(plane, glm::abs(center) + radius)) return false;
  }
  return true;
}

bool may_intersect(const Frustum& frustum, const Aabb& box) {
  if (has_nan(box.min) || has_nan(box.max)) return true;
  if (box.min.x > box.max.x || box.min.y > box.max.y || box.min.z > box.max.z) return false;
  const dvec3 low(box.min);
  const dvec3 high(box.max);
  const dvec3 reach = glm::max(glm::abs(low), glm::abs(high));
  for (const Plane& plane : frustum.planes) {
    const dvec3 normal(plane.normal);
    // The box corner farthest along the normal.
    const dvec3 corner(normal.x > 0.0 ? high.x : low.x, normal.y > 0.0 ? high.y : low.y,
                       normal.z > 0.0 ? high.z : low.z);
    const double distance = glm::dot(normal, corner) + plane.distance;
    if (distance < -distance_rounding(plane, reach)) return false;
  }
  return true;
}

}  // namespace gloam
