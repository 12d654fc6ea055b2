// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/reference/lens_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/math/low_discrepancy.h"

namespace gloam {
namespace {

/// Shirley and Chiu 1997, "A Low Distortion Map Between Disk and Square": keeps neighbours together.
glm::dvec2 on_disc(double u, double v) {
  const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
  if (a == 0.0 && b == 0.0) return glm::dvec2(0.0);
  const bool wide = std::abs(a) > std::abs(b);
  const double radius = wide ? a : b;
  const double angle = 0.25 * std::numbers::pi * (wide ? b / a : 2.0 - a / b);
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// The hexagon is three rhombi that meet at its centre.
glm::dvec2 on_hexagon(double u, double v) {
  const double thirds = 3.0 * u;
  const int rhombus = std::min(static_cast<int>(thirds), 2);
  const auto corner = [](int number) {
    const double angle = std::numbers::pi * (0.5 + 2.0 * number / 3.0);
    return glm::dvec2(std::cos(angle), std::sin(angle));
  };
  return (thirds - rhombus) * corner(rhombus) + v * corner(rhombus + 1);
}

}  // namespace

glm::dvec2 lens_point(Bokeh bokeh, std::uint32_t index) {
  const double u = unit_fraction(reversed_bits(index)), v = unit_fraction(second_sobol(index));
  return bokeh == Bokeh::round ? on_disc(u, v) : on_hexagon(u, v);
}

}  // namespace gloam
