// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <iomanip>
#include <limits>

#include "engine/math/bounds.h"
#include "engine/math/screen_bounds.h"

/// Random inputs for the property tests of engine/math, mostly hard ones.
namespace gloam::test {

/// Uniform in [low, high].
inline double draw(double low, double high) {
  constexpr std::uint32_t kSteps = 1u << 30;
  const auto step = *rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::uint32_t>(0, kSteps + 1));
  return low + (high - low) * (static_cast<double>(step) / kSteps);
}

/// Uniform integer in [0, count).
inline int draw_index(int count) { return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(0, count)); }

/// Length between 10^low and 10^high metres, uniform in its logarithm.
inline double draw_length(double low, double high) { return std::pow(10.0, draw(low, high)); }

/// Unit vector, uniform over the sphere; one in eight is a coordinate axis or its negative.
inline dvec3 draw_direction() {
  if (draw_index(8) == 0) {
    dvec3 axis(0.0);
    axis[draw_index(3)] = draw_index(2) == 0 ? -1.0 : 1.0;
    return axis;
  }
  const double z = draw(-1.0, 1.0);
  const double angle = draw(0.0, 2.0 * 3.14159265358979323846);
  const double across = std::sqrt(1.0 - z * z);
  return {across * std::cos(angle), across * std::sin(angle), z};
}

inline PerspectiveScale draw_projection() {
  const float near_m = static_cast<float>(draw_index(4) == 0 ? draw_length(-6.0, 2.0) : draw_length(-2.0, 0.0));
  return {vec2(draw(0.3, 4.0), draw(0.3, 4.0)), near_m};
}

/// Centre for a body of this size, in view space: anywhere, around the camera, touching the near plane from either
/// side, across the near plane, in front of the camera, or on the view axis.
inline vec3 draw_center(double size, double near_m) {
  const double far = draw_length(-6.0, 6.0);
  const dvec3 direction = draw_direction();
  switch (draw_index(6)) {
    case 0:
      return vec3(direction * far);
    case 1:
      return vec3(direction * (size * draw(0.0, 2.0)));
    case 2:
      return vec3(dvec3(direction.x * size, direction.y * size, -near_m + size * (draw_index(2) == 0 ? 1 : -1)));
    case 3:
      return vec3(dvec3(direction.x * size, direction.y * size, -near_m + size * draw(-1.2, 1.2)));
    case 4:
      return vec3(dvec3(direction.x, direction.y, -std::abs(direction.z)) * (size * draw_length(0.0, 3.0)));
    default:
      return vec3(dvec3(0.0, 0.0, direction.z * far));
  }
}

inline Sphere draw_sphere(double near_m) {
  const double radius = draw_index(16) == 0 ? 0.0 : draw_length(-6.0, 6.0);
  return {draw_center(radius, near_m), static_cast<float>(radius)};
}

inline Cone draw_cone(double near_m) {
  const double range = draw_length(-6.0, 6.0);
  double half_angle = draw(0.01, 1.5707);
  if (draw_index(8) == 0) half_angle = draw_length(-4.0, -2.0);
  if (draw_index(8) == 0) half_angle = 0.5 * kPi;
  return {draw_center(range, near_m), glm::normalize(vec3(draw_direction())), static_cast<float>(half_angle),
          static_cast<float>(range)};
}

inline void log_case(const Cone& cone, const PerspectiveScale& projection) {
  RC_LOG() << std::setprecision(9) << "apex " << cone.apex.x << ' ' << cone.apex.y << ' ' << cone.apex.z << ", axis "
           << cone.axis.x << ' ' << cone.axis.y << ' ' << cone.axis.z << ", half angle " << cone.half_angle
           << ", range " << cone.range_m << ", scale " << projection.scale.x << ' ' << projection.scale.y << ", near "
           << projection.near_m << '\n';
}

inline void log_case(const Sphere& sphere, const PerspectiveScale& projection) {
  RC_LOG() << std::setprecision(9) << "center " << sphere.center.x << ' ' << sphere.center.y << ' ' << sphere.center.z
           << ", radius " << sphere.radius << ", scale " << projection.scale.x << ' ' << projection.scale.y << ", near "
           << projection.near_m << '\n';
}

}  // namespace gloam::test
