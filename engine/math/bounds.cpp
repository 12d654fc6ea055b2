// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/math/bounds.h"

#include <algorithm>
#include <cmath>

#include "engine/core/assert.h"
#include "engine/math/rounding.h"

namespace gloam {
namespace {

constexpr double kPiDouble = 3.14159265358979323846;

bool has_nan(const Aabb& box, const mat4& affine) {
  bool found = false;
  for (int row = 0; row < 3; ++row) {
    found |= std::isnan(box.min[row]) || std::isnan(box.max[row]);
    for (int column = 0; column < 4; ++column) found |= std::isnan(affine[column][row]);
  }
  return found;
}

/// Sphere with its centre rounded to float and its radius grown so that it still contains the exact sphere.
Sphere enclosing(dvec3 center, double radius) {
  const vec3 rounded(center);
  const double moved = glm::length(center - dvec3(rounded));
  return {rounded, float_at_least((radius + moved) * (1.0 + 1e-15))};
}

}  // namespace

Aabb transformed(const Aabb& box, const mat4& affine) {
  if (has_nan(box, affine)) {
    const vec3 nan(std::numeric_limits<float>::quiet_NaN());
    return {nan, nan};
  }
  if (box.empty()) return {};
  Aabb result;
  for (int row = 0; row < 3; ++row) {
    double low = affine[3][row];
    double high = affine[3][row];
    for (int column = 0; column < 3; ++column) {
      const double factor = affine[column][row];
      if (factor == 0.0) continue;  // avoids 0 · infinity = NaN
      const double a = factor * box.min[column];
      const double b = factor * box.max[column];
      low += std::min(a, b);
      high += std::max(a, b);
    }
    result.min[row] = float_at_most(low);
    result.max[row] = float_at_least(high);
  }
  return result;
}

Sphere bounding_sphere(const Cone& cone) {
  GLOAM_ASSERT(!(cone.half_angle < 0.0f) && !(cone.half_angle > kPi * 0.5f), "a cone's half angle is at most pi/2");
  GLOAM_ASSERT(!(cone.range_m < 0.0f), "a cone's range is not negative");
  const double angle = std::min<double>(cone.half_angle, kPiDouble / 2);
  const double range = cone.range_m;
  const dvec3 axis = glm::normalize(dvec3(cone.axis));
  // Narrow cones: the sphere through the apex and the rim. Wide cones: the sphere with the rim as a great circle. Both
  // contain the cap.
  const double narrow = range / (2.0 * std::cos(angle));
  const bool wide = angle > kPiDouble / 4;
  const double along = wide ? range * std::cos(angle) : narrow;
  const double radius = wide ? range * std::sin(angle) : narrow;
  return enclosing(dvec3(cone.apex) + along * axis, radius);
}

Sphere bounding_sphere(const Aabb& box) {
  GLOAM_ASSERT(!(box.min.x > box.max.x || box.min.y > box.max.y || box.min.z > box.max.z),
               "an empty box has no bounding sphere");
  const dvec3 low(box.min);
  const dvec3 high(box.max);
  return enclosing((low + high) * 0.5, glm::length(high - low) * 0.5);
}

}  // namespace gloam
