// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/glare/reference/spread_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "engine/jobs/executor.h"
#include "modules/glare/levels.h"

namespace gloam {
namespace {

struct SpreadLight : ::testing::Test {
  std::unique_ptr<JobExecutor> executor = make_serial_executor();
};

/// The share of a lamp's scattered light in a pixel dx, dy pixels away, summed over points of the pixel.
double pixel_sum(int dx, int dy, double height) {
  constexpr int kSteps = 64;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double x = dx + (i + 0.5) / kSteps - 0.5, y = dy + (j + 0.5) / kSteps - 0.5;
      for (const GlareGaussian& g : glare_spread()) {
        const double sigma = g.sigma * height;
        sum += g.share / (2.0 * std::numbers::pi * sigma * sigma) * std::exp(-0.5 * (x * x + y * y) / (sigma * sigma));
      }
    }
  return sum / (kSteps * kSteps);
}

TEST_F(SpreadLight, of_a_pixel_is_the_integral_of_the_spread) {
  constexpr std::uint32_t kWidth = 64, kHeight = 48;
  std::vector<vec4> light(kWidth * kHeight, vec4(0.0f));
  light[20 * kWidth + 30] = vec4(100.0f, 50.0f, 0.0f, 1.0f);
  const std::vector<dvec3> spread = spread_light(light, {kWidth, kHeight}, *executor);
  for (const auto& [x, y] :
       {std::pair(30, 20), std::pair(31, 20), std::pair(30, 25), std::pair(50, 3), std::pair(0, 47)}) {
    const double share = pixel_sum(x - 30, y - 20, kHeight);
    const dvec3 found = spread[static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)];
    EXPECT_NEAR(found.x, 100.0 * share, 1e-3 * 100.0 * share);
    EXPECT_NEAR(found.y, 50.0 * share, 1e-3 * 50.0 * share);
    EXPECT_EQ(found.z, 0.0);
  }
}

TEST_F(SpreadLight, of_what_is_not_finite_is_bounded) {
  std::vector<vec4> light(9, vec4(0.0f));
  light[4] = vec4(std::numeric_limits<float>::infinity(), std::nanf(""), -1.0f, 1.0f);
  for (const dvec3& value : spread_light(light, {3, 3}, *executor)) {
    EXPECT_GT(value.x, 0.0);
    EXPECT_LE(value.x, 65504.0);
    EXPECT_EQ(value.y, 0.0);
    EXPECT_EQ(value.z, 0.0);
  }
}

}  // namespace
}  // namespace gloam
