// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/modules/glare/support/glare_kernel.h"

namespace gloam::test {
namespace {

constexpr float kBrightestHalf = 65504.0f;

/// Lamps of many strengths on dim noise.
GlareInput night(uvec2 size, std::uint32_t seed) {
  GlareInput in(size);
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (vec4& light : in.light) {
    const float dim = static_cast<float>(between(0.01, 0.1));
    light = vec4(dim, 0.5f * dim, 2.0f * dim, 1.0f);
  }
  for (int i = 0; i < 30; ++i)
    in.add_lamp({between(0.0, size.x - 2.0), between(0.0, size.y - 2.0)}, std::exp(between(0.0, 9.0)));
  return in;
}

class GlarePictures : public GlareKernelTest {
 protected:
  /// Mean difference over the mean light.
  static double mean_error(const std::vector<vec4>& found, const std::vector<glm::dvec3>& expected) {
    double apart = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < found.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        apart += std::abs(static_cast<double>(found[i][c]) - expected[i][c]);
        sum += expected[i][c];
      }
    return apart / sum;
  }
};

TEST_F(GlarePictures, are_near_the_convolution_and_nearest_with_as_many_lines_as_the_picture_needs) {
  for (const uvec2 size : {uvec2(320, 180), uvec2(333, 270), uvec2(200, 360)}) {
    GlareInput in = night(size, size.y);
    const std::vector<glm::dvec3> expected = right(in);
    std::vector<double> errors;
    for (const std::uint32_t lines : {45u, 90u, 180u}) {
      in.lines = lines;
      errors.push_back(mean_error(run(in), expected));
    }
    SCOPED_TRACE(std::to_string(size.x) + "x" + std::to_string(size.y) + ": " + std::to_string(errors[0]) + ", " +
                 std::to_string(errors[1]) + ", " + std::to_string(errors[2]));
    EXPECT_LT(errors[1], 0.5 * errors[0]);
    // With cells of a pixel, more lines change little: what is left is that the levels' blurs are not quite Gaussians.
    if (size.y > 180) {
      EXPECT_LT(errors[2], 0.8 * errors[1]);
    }
    EXPECT_LT(errors[1], 0.05);
    EXPECT_LT(errors[2], 0.035);
  }
}

TEST_F(GlarePictures, with_a_share_are_the_sum_of_the_sharp_and_the_spread_light) {
  GlareInput in = night(uvec2(160, 90), 7);
  const std::vector<vec4> spread = run(in);
  in.share = 0.2f;
  const std::vector<vec4> shown = run(in);
  for (std::size_t i = 0; i < shown.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double light = static_cast<double>(in.light[i][c]);
      const double expected = 0.8 * light + 0.2 * static_cast<double>(spread[i][c]);
      ASSERT_NEAR(static_cast<double>(shown[i][c]), expected, 2e-3 * expected) << i;
    }
}

// A picture that is the same everywhere keeps its light, away from the edges.
TEST_F(GlarePictures, of_even_light_stay_even) {
  const GlareInput in(uvec2(2000, 1000), 3.0f);
  const std::vector<vec4> found = run(in);
  const std::vector<vec4>::const_iterator row = found.begin() + 500 * 2000;
  // The widest Gaussian loses a part at the edges even here: at the middle of the height, 16 %.
  for (std::uint32_t x = 901; x < 1100; ++x)
    EXPECT_NEAR(static_cast<double>(row[x].x) / static_cast<double>(row[900].x), 1.0, 1e-3) << x;
  EXPECT_GT(row[1000].x, 0.95f * 3.0f);
  EXPECT_LE(row[1000].x, 3.0f);
}

// Hard case: glare.sizes
TEST_F(GlarePictures, of_any_size_are_finite_and_dimmer_than_their_light) {
  for (const uvec2 size : {uvec2(1, 1), uvec2(1, 50), uvec2(500, 1), uvec2(2, 3), uvec2(91, 89), uvec2(37, 211),
                           uvec2(7, 5), uvec2(4000, 3)})
    for (const std::uint32_t lines : {45u, 180u}) {
      SCOPED_TRACE(std::to_string(size.x) + "x" + std::to_string(size.y) + ", lines " + std::to_string(lines));
      GlareInput in(size, 1.0f);
      in.lines = lines;
      for (const vec4& light : run(in)) {
        ASSERT_GT(light.x, 0.05f);
        ASSERT_LE(light.x, 1.001f);
      }
    }
}

// A light of 1e9 cd/m² is infinite in half floats.
// Hard case: glare.not_finite
TEST_F(GlarePictures, count_infinite_light_as_the_brightest_and_what_is_no_number_as_none) {
  GlareInput in(uvec2(64, 48), 0.5f), clean = in;
  const float inf = std::numeric_limits<float>::infinity();
  in.at(10, 20) = vec4(std::nanf(""), 1.0f, std::nanf(""), 1.0f);
  clean.at(10, 20) = vec4(0.0f, 1.0f, 0.0f, 1.0f);
  in.at(40, 5) = vec4(1e9f, inf, -inf, 1.0f);
  clean.at(40, 5) = vec4(kBrightestHalf, kBrightestHalf, 0.0f, 1.0f);
  in.at(63, 47) = vec4(-5.0f, -0.0f, 1e-8f, 1.0f);
  clean.at(63, 47) = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  const std::vector<vec4> found = run(in), expected = run(clean);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const bool bad = i == 20 * 64 + 10 || i == 5 * 64 + 40;  // these stay what they are: 0 times infinity
    if (bad) continue;
    for (int c = 0; c < 3; ++c) {
      ASSERT_TRUE(std::isfinite(found[i][c])) << i;
      ASSERT_NEAR(found[i][c], expected[i][c], 1e-3f * expected[i][c]) << i;
    }
  }
}

// Hard case: glare.not_finite
TEST_F(GlarePictures, of_the_brightest_light_everywhere_are_finite) {
  const GlareInput in(uvec2(640, 360), kBrightestHalf);
  for (const vec4& light : run(in)) {
    ASSERT_GT(light.x, 0.1f * kBrightestHalf);
    ASSERT_LE(light.x, kBrightestHalf);
  }
}

}  // namespace
}  // namespace gloam::test
