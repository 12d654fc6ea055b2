// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/reference/lens_points.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gloam::test {
namespace {

constexpr std::uint32_t kPoints = 4096;

TEST(LensPoints, fill_the_disc_evenly) {
  glm::dvec2 mean(0.0);
  double squares = 0.0;
  std::uint32_t inner = 0;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const glm::dvec2 p = lens_point(Bokeh::round, i);
    const double radius = glm::length(p);
    ASSERT_LE(radius, 1.0 + 1e-12);
    mean += p;
    squares += radius * radius;
    inner += radius < std::sqrt(0.5) ? 1 : 0;
  }
  EXPECT_LT(glm::length(mean) / kPoints, 1e-3);
  EXPECT_NEAR(squares / kPoints, 0.5, 1e-3);  // of a disc
  EXPECT_NEAR(inner / static_cast<double>(kPoints), 0.5, 2e-3);
}

TEST(LensPoints, fill_the_hexagon_evenly) {
  glm::dvec2 mean(0.0);
  double squares = 0.0;
  std::uint32_t sextants[6] = {};
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const glm::dvec2 p = lens_point(Bokeh::hexagonal, i);
    for (int side = 0; side < 6; ++side) {
      const double angle = std::numbers::pi / 3.0 * side;  // normals of the sides; a corner is at +y
      ASSERT_LE(p.x * std::cos(angle) + p.y * std::sin(angle), std::sqrt(0.75) + 1e-12);
    }
    mean += p;
    squares += p.x * p.x + p.y * p.y;
    const double turn = std::atan2(p.y, p.x) / (2.0 * std::numbers::pi) + 1.0 + 1.0 / 12.0;
    ++sextants[static_cast<int>(6.0 * turn) % 6];
  }
  EXPECT_LT(glm::length(mean) / kPoints, 1e-3);
  EXPECT_NEAR(squares / kPoints, 5.0 / 12.0, 2e-3);  // of a hexagon
  for (const std::uint32_t count : sextants) EXPECT_NEAR(6.0 * count / kPoints, 1.0, 0.03);
}

TEST(LensPoints, half_of_the_points_are_even_too) {
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
    glm::dvec2 mean(0.0);
    for (std::uint32_t i = 0; i < 128; ++i) mean += lens_point(bokeh, i);
    EXPECT_LT(glm::length(mean) / 128.0, 0.02);
  }
}

}  // namespace
}  // namespace gloam::test
