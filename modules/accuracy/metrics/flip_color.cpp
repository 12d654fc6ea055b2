// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/metrics/flip_color.h"

#include <cmath>

namespace gloam::flip {
namespace {

using Matrix = std::array<Color, 3>;

/// Linear sRGB to CIE XYZ, as exact fractions of the primaries' chromaticities.
constexpr Matrix kXyzFromLinear = {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
                                    {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
                                    {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};

constexpr Matrix inverse_of(const Matrix& m) {
  Matrix result{};
  double determinant = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t r0 = (j + 1) % 3;
      const std::size_t r1 = (j + 2) % 3;
      const std::size_t c0 = (i + 1) % 3;
      const std::size_t c1 = (i + 2) % 3;
      result[i][j] = m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) determinant += m[0][i] * result[i][0];
  for (Color& row : result) {
    for (double& value : row) value /= determinant;
  }
  return result;
}

constexpr Color product(const Matrix& m, const Color& v) {
  Color result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
  return result;
}

constexpr Matrix kLinearFromXyz = inverse_of(kXyzFromLinear);
constexpr Color kWhite = product(kXyzFromLinear, {1.0, 1.0, 1.0});

double lab_curve(double t) {
  constexpr double kDelta = 6.0 / 29.0;
  return t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0 * kDelta * kDelta) + 4.0 / 29.0;
}

}  // namespace

Color ycxcz_from_linear(const Color& rgb) {
  const Color xyz = product(kXyzFromLinear, rgb);
  const double x = xyz[0] / kWhite[0];
  const double y = xyz[1] / kWhite[1];
  const double z = xyz[2] / kWhite[2];
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

Color linear_from_ycxcz(const Color& ycxcz) {
  const double y = (ycxcz[0] + 16.0) / 116.0;
  const double x = y + ycxcz[1] / 500.0;
  const double z = y - ycxcz[2] / 200.0;
  return product(kLinearFromXyz, {x * kWhite[0], y * kWhite[1], z * kWhite[2]});
}

Color hunt_lab_from_linear(const Color& rgb) {
  const Color xyz = product(kXyzFromLinear, rgb);
  const double x = lab_curve(xyz[0] / kWhite[0]);
  const double y = lab_curve(xyz[1] / kWhite[1]);
  const double z = lab_curve(xyz[2] / kWhite[2]);
  const double lightness = 116.0 * y - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (x - y), 0.01 * lightness * 200.0 * (y - z)};
}

double hyab(const Color& a, const Color& b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

}  // namespace gloam::flip
