// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/diffuse/harmonics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/assert.h"
#include "engine/math/finite.h"
#include "modules/reflections/bake/cube.h"

namespace gloam {
namespace {

using Terms = std::array<double, kDiffuseTerms>;

/// Factors that make the harmonics orthonormal.
constexpr Terms kNormalized = {0.28209479177387814, 0.4886025119029199, 0.4886025119029199,
                               0.4886025119029199,  1.0925484305920792, 1.0925484305920792,
                               0.31539156525252005, 1.0925484305920792, 0.5462742152960396};
/// The cosine lobe's, π, 2 π / 3 and π / 4, over π.
constexpr Terms kCosineLobe = {1.0, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0, 0.25, 0.25, 0.25, 0.25, 0.25};
constexpr std::size_t kLinear = 1, kQuadratic = 4;  // first terms
// 1 / 4 + a x / 2 + b (15 x² − 5) / 32 ≥ 0 for all x needs a² ≤ 15 / 8 · b (1 − 5 b / 8); b = 4 / 5 allows the largest
// a.
constexpr double kLinearWindow = 0.8660254037844386, kQuadraticWindow = 0.8;
constexpr int kDirections = 512;  // in which the sign is looked at

Terms monomials(const dvec3& n) {
  return {1.0, n.y, n.z, n.x, n.x * n.y, n.y * n.z, 3.0 * n.z * n.z - 1.0, n.x * n.z, n.x * n.x - n.y * n.y};
}

/// Directions of a Fibonacci spiral.
dvec3 spread_direction(int index) {
  const double z = 1.0 - (2.0 * index + 1.0) / kDirections, radius = std::sqrt(1.0 - z * z);
  const double angle = index * std::numbers::pi * (3.0 - std::sqrt(5.0));
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

/// How much of the window the terms need, 0…1.
double needed_window(const std::array<dvec3, kDiffuseTerms>& terms) {
  double needed = 0.0;
  for (int i = 0; i < kDirections; ++i) {
    const Terms at = monomials(spread_direction(i));
    dvec3 value(0.0), windowed(0.0);
    for (std::size_t k = 0; k < kDiffuseTerms; ++k) {
      value += at[k] * terms[k];
      windowed += (k < kLinear ? 1.0 : k < kQuadratic ? kLinearWindow : kQuadraticWindow) * at[k] * terms[k];
    }
    for (int c = 0; c < 3; ++c)
      if (value[c] < 0.0) needed = std::max(needed, windowed[c] > 0.0 ? value[c] / (value[c] - windowed[c]) : 1.0);
  }
  return needed;
}

}  // namespace

void Harmonics::add(const dvec3& direction, const dvec3& radiance, double solid_angle) {
  const Terms at = monomials(direction);
  for (std::size_t k = 0; k < kDiffuseTerms; ++k) coefficients[k] += (solid_angle * kNormalized[k] * at[k]) * radiance;
}

Harmonics project_cube(const std::array<CapturedPicture, 6>& faces) {
  const std::uint32_t side = faces[0].width;
  GLOAM_ASSERT(side > 0, "a cube has texels");
  Harmonics sum;
  double total = 0.0;
  const auto each_texel = [&](const auto& visit) {
    for (std::uint32_t face = 0; face < 6; ++face) {
      const CubeFaceAxes axes = cube_face_axes(face);
      for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
          const double u = (2.0 * x + 1.0) / side - 1.0, v = 1.0 - (2.0 * y + 1.0) / side;
          const dvec3 toward = axes.forward + u * axes.right + v * axes.up;
          visit(toward, std::pow(1.0 + u * u + v * v, -1.5), faces[face].texels[std::size_t{y} * side + x]);
        }
    }
  };
  each_texel([&](const dvec3&, double weight, const vec4&) { total += weight; });
  each_texel([&](const dvec3& toward, double weight, const vec4& texel) {
    const dvec3 radiance(texel);
    if (is_finite(radiance)) sum.add(glm::normalize(toward), radiance, 4.0 * std::numbers::pi * weight / total);
  });
  return sum;
}

std::array<dvec3, kDiffuseTerms> diffuse_terms(const Harmonics& environment) {
  std::array<dvec3, kDiffuseTerms> terms{};
  for (std::size_t k = 0; k < kDiffuseTerms; ++k)
    terms[k] = (kCosineLobe[k] * kNormalized[k]) * environment.coefficients[k];
  const double window = needed_window(terms);
  for (std::size_t k = kLinear; k < kDiffuseTerms; ++k)
    terms[k] *= 1.0 - window * (1.0 - (k < kQuadratic ? kLinearWindow : kQuadraticWindow));
  return terms;
}

dvec3 diffuse_value(const std::array<dvec3, kDiffuseTerms>& terms, const dvec3& normal) {
  const Terms at = monomials(normal);
  dvec3 value(0.0);
  for (std::size_t k = 0; k < kDiffuseTerms; ++k) value += at[k] * terms[k];
  return value;
}

}  // namespace gloam
