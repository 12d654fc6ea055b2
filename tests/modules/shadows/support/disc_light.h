// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace gloam::test {

/// Share of a disc of radius 1 that lies at x > cut.
[[nodiscard]] inline double disc_beyond(double cut) {
  const double c = std::clamp(cut, -1.0, 1.0);
  return (std::acos(c) - c * std::sqrt(1.0 - c * c)) / std::numbers::pi;
}

/// Visibility of a disc light, `height_m` above a floor, on the floor at `x_m` from where the shadow edge of a point
/// light would be; the half plane that blocks is `gap_m` above the floor, parallel to it, and shadows what has x < 0.
[[nodiscard]] inline double half_plane_visibility(double x_m, double height_m, double gap_m, double width_m) {
  const double penumbra = gap_m * width_m / (height_m - gap_m);
  return disc_beyond(-2.0 * x_m / penumbra);
}

/// Where a curve that rises with x crosses `level` first, between `low` and `high`.
[[nodiscard]] inline double crossing(const std::function<double(double)>& curve, double level, double low,
                                     double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (curve(middle) < level ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace gloam::test
