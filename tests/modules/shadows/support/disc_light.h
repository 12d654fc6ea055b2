// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace gloam::test {

/// Share of a disc of radius 1 with x > cut.
[[nodiscard]] inline double disc_beyond(double cut) {
  const double c = std::clamp(cut, -1.0, 1.0);
  return (std::acos(c) - c * std::sqrt(1.0 - c * c)) / std::numbers::pi;
}

/// Visibility of a disc light, `height_m` above a floor. A horizontal half plane, `gap_m` above the floor, blocks it.
/// x_m: distance on the floor from the shadow edge that a point light would cast; x < 0 is in shadow.
[[nodiscard]] inline double half_plane_visibility(double x_m, double height_m, double gap_m, double width_m) {
  const double penumbra = gap_m * width_m / (height_m - gap_m);
  return disc_beyond(-2.0 * x_m / penumbra);
}

/// The first x between `low` and `high` at which a rising curve crosses `level`.
[[nodiscard]] inline double crossing(const std::function<double(double)>& curve, double level, double low,
                                     double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (curve(middle) < level ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace gloam::test
