// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "modules/depth_of_field/reference/blur_twin.h"
#include "modules/depth_of_field/reference/kernel_checks.h"
#include "tests/modules/depth_of_field/support/dof_chain.h"

namespace gloam::test {
namespace {

class DofBlur : public DofChainTest {
 protected:
  /// Compares all pixels with the twin, within eight steps of half floats. Each pass rounds to one, and devices
  /// interpolate the near layer's radius with weights of few bits.
  static void expect_twin(const DofInput& in) {
    const DofResult result = run(in);
    const std::vector<dvec4> expected = dof_twin_light(in);
    ASSERT_EQ(result.light.size(), expected.size());
    double worst = 0.0;
    std::size_t place = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const double apart = std::abs(static_cast<double>(result.light[i][c]) - expected[i][c]);
        const double error = apart / (std::abs(expected[i][c]) + 0.01);
        if (error > worst || std::isnan(error)) place = i;
        worst = std::isnan(error) ? 1e9 : std::max(worst, error);
      }
    EXPECT_LT(worst, 8.0 / 1024.0) << name_of(in) << " at " << place % in.width << ", " << place / in.width << ": "
                                   << result.light[place].x << " in place of " << expected[place].x;
  }
  static std::string name_of(const DofInput& in) {
    return std::string(in.bokeh == Bokeh::round ? "round" : "hexagonal") +
           (in.knobs.full_resolution ? ", full" : ", half") + ", radius " +
           std::to_string(static_cast<int>(in.knobs.radius)) + ", " + std::to_string(in.width) + "x" +
           std::to_string(in.height);
  }
  static void expect_twins(DofInput in, std::initializer_list<float> radii) {
    for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal})
      for (const bool full : {false, true})
        for (const float radius : radii) {
          in.bokeh = bokeh;
          in.knobs.full_resolution = full;
          in.knobs.radius = radius;
          expect_twin(in);
        }
  }
};
INSTANTIATE_TEST_SUITE_P(Variants, DofBlur, testing::Bool());

TEST_P(DofBlur, equals_the_twin_in_a_picture_with_objects_before_and_behind_the_focus) {
  expect_twins(objects_in_depth(112, 80, 1), {3.0f, 15.0f, 31.0f});
}

TEST_P(DofBlur, holds_in_the_self_test) {
  for (const KernelCheck& check : dof_kernel_checks()) {
    KernelLab lab(*device(), gpu_log());
    const auto found = check.run(lab);
    ASSERT_TRUE(found.ok()) << check.name << ": " << found.error().message;
    EXPECT_LE(found->worst, check.bound) << check.name << ": " << found->where;
  }
}

TEST_P(DofBlur, equals_the_twin_in_pictures_of_odd_sizes) {
  for (const auto& [width, height] : {std::pair{81u, 67u}, {33u, 1u}, {1u, 35u}, {129u, 17u}})
    expect_twins(objects_in_depth(width, height, width), {7.0f, 23.0f});
}

// Hard case: dof.radius_large
TEST_P(DofBlur, equals_the_twin_where_the_radius_exceeds_the_picture) {
  for (const float circle : {30.0f, -30.0f}) {
    DofInput in = objects_in_depth(9, 7, 5);
    std::ranges::fill(in.coc, circle);
    expect_twins(in, {31.0f});
  }
}

// Hard case: dof.size_1x1
TEST_P(DofBlur, keeps_a_picture_of_one_pixel) {
  for (const float circle : {30.0f, 0.0f, -30.0f})
    for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal})
      for (const bool full : {false, true}) {
        DofInput in(1, 1, circle, vec4(2.0f, 0.5f, 3.0f, 1.0f));
        in.knobs.full_resolution = full;
        in.bokeh = bokeh;
        const DofResult result = run(in);
        for (int c = 0; c < 3; ++c)
          EXPECT_NEAR(result.light[0][c], in.light[0][c], 2e-3f * in.light[0][c]) << name_of(in) << " " << circle;
      }
}

TEST_P(DofBlur, leaves_an_even_picture_as_it_is) {
  for (const float circle : {20.0f, 3.0f, -3.0f, -20.0f}) {
    const DofInput in(70, 50, circle, vec4(0.7f));
    for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
      DofInput even = in;
      even.bokeh = bokeh;
      for (const vec4& light : run(even).light) ASSERT_NEAR(light.x, 0.7f, 3e-3f) << name_of(even) << " " << circle;
    }
  }
}

}  // namespace
}  // namespace gloam::test
