// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "tests/modules/shadows/support/maps.h"

namespace gloam::test {

inline constexpr double kGoldenAngle = 2.39996322972865332;

/// Part of an emitter that rays from `at` reach: a disc of this width around `center`, with this normal.
[[nodiscard]] inline double traced_disc(const RayScene& scene, const dvec3& at, const dvec3& center,
                                        const dvec3& normal, double width_m) {
  constexpr int kRays = 1024;
  const dvec3 side = normalize(cross(normal, std::abs(normal.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
  const dvec3 up = cross(side, normal);
  int reached = 0;
  for (int i = 0; i < kRays; ++i) {
    const double radius = 0.5 * width_m * std::sqrt((i + 0.5) / kRays), angle = i * kGoldenAngle;
    const dvec3 end = center + radius * (std::cos(angle) * side + std::sin(angle) * up);
    const double t = scene(at, end - at);
    reached += !(t > 0.0 && t < 1.0) ? 1 : 0;
  }
  return static_cast<double>(reached) / kRays;
}

}  // namespace gloam::test
