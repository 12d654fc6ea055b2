// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/levels.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "modules/glare/reference/spread_light.h"
#include "shaders/glare/glare_shared.h"

namespace gloam {
namespace {

/// The point spread at a distance in heights of the picture.
double spread_at(double distance) {
  double sum = 0.0;
  for (const GlareGaussian& g : glare_spread())
    sum += g.share / (2.0 * std::numbers::pi * g.sigma * g.sigma) * std::exp(-0.5 * std::pow(distance / g.sigma, 2.0));
  return sum;
}

TEST(GlareSpread, keeps_all_light) {
  double sum = 0.0;
  for (const GlareGaussian& gaussian : glare_spread()) sum += gaussian.share;
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(GlareSpread, falls_with_the_distance_to_a_power_between_two_and_three) {
  for (double distance = 1.0 / 40.0; distance < 1.0 / 3.0; distance *= 1.3) {
    const double slope = std::log2(spread_at(2.0 * distance) / spread_at(distance));
    EXPECT_LT(slope, -2.0) << distance;
    EXPECT_GT(slope, -3.0) << distance;
  }
}

/// Variance of the light that the levels give a point, along an axis, in heights squared.
double variance_of(const GlareLevels& levels, std::uint32_t height) {
  double variance = 0.0;
  for (std::uint32_t i = 0; i < levels.levels.size(); ++i)
    variance += static_cast<double>(levels.levels[i].weight) *
                std::pow(std::ldexp(glare_level_sigma(i), static_cast<int>(i)) * levels.cell_px / height, 2.0);
  return variance;
}

TEST(GlareLevels, have_the_width_of_the_spread_at_any_size) {
  double right = 0.0;
  for (const GlareGaussian& gaussian : glare_spread()) right += gaussian.share * gaussian.sigma * gaussian.sigma;
  for (const std::uint32_t height : {180u, 270u, 333u, 540u, 1080u, 2160u})
    for (const std::uint32_t lines : {45u, 90u, 180u}) {
      const GlareLevels levels = glare_levels({height * 16 / 9, height}, lines);
      EXPECT_NEAR(std::sqrt(variance_of(levels, height) / right), 1.0, 0.01) << height << ", lines " << lines;
    }
}

// Hard case: glare.sizes
TEST(GlareLevels, cover_pictures_of_any_shape_and_keep_all_light) {
  for (const uvec2 picture : {uvec2(1, 1), uvec2(1, 4000), uvec2(16384, 1), uvec2(16384, 16384), uvec2(641, 359),
                              uvec2(2, 3), uvec2(4000, 89), uvec2(90, 91)})
    for (const std::uint32_t lines : {45u, 90u, 180u}) {
      SCOPED_TRACE(std::to_string(picture.x) + "x" + std::to_string(picture.y) + ", lines " + std::to_string(lines));
      const GlareLevels levels = glare_levels(picture, lines);
      EXPECT_GE(levels.cell_px, 1.0);
      EXPECT_LE(levels.cells.y, lines);
      EXPECT_LE(levels.origin_px.x, 1e-6);
      EXPECT_NEAR(levels.origin_px.x + 0.5 * levels.cells.x * levels.cell_px, 0.5 * picture.x, 1e-6);
      EXPECT_NEAR(levels.origin_px.y + 0.5 * levels.cells.y * levels.cell_px, 0.5 * picture.y, 1e-6);
      EXPECT_LE(std::max(levels.cells.x, levels.cells.y), 2000u) << "an image that every device can make";
      const double limit = std::max(picture.x, picture.y) / 2000.0;
      const double rows_px = levels.cells.y * levels.cell_px;
      EXPECT_TRUE(levels.cell_px <= limit * 1.0001 || std::abs(rows_px - picture.y) < 1e-6) << rows_px;
      double sum = 0.0;
      for (const GlareLevel& level : levels.levels) {
        EXPECT_GE(level.weight, 0.0f);
        sum += static_cast<double>(level.weight);
      }
      EXPECT_NEAR(sum, 1.0, 1e-6);
      EXPECT_GT(levels.levels.back().weight, 0.0f);
      EXPECT_EQ(levels.levels.front().size, levels.cells + 2u * GLOAM_GLARE_MARGIN);
    }
}

}  // namespace
}  // namespace gloam
