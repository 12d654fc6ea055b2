// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/modules/depth_of_field/support/dof_stage.h"

namespace gloam::test {
namespace {

/// One lens in pictures of several sizes.
class DofSizes : public DofStageTest {
 protected:
  /// Radius of an even disc with the second moment of the light, as a share of the picture's height.
  static double radius_of(const LinearPicture& picture) {
    double light = 0.0;
    glm::dvec2 centre(0.0);
    const auto each = [&](const auto& add) {
      for (std::uint32_t y = 0; y < picture.height; ++y)
        for (std::uint32_t x = 0; x < picture.width; ++x)
          add(glm::dvec2(x, y), static_cast<double>(picture.rgba[4 * (std::size_t{y} * picture.width + x)]));
    };
    each([&](const glm::dvec2& at, double value) {
      light += value;
      centre += value * at;
    });
    centre /= light;
    double squares = 0.0;
    each([&](const glm::dvec2& at, double value) { squares += value * glm::dot(at - centre, at - centre); });
    return std::sqrt(2.0 * squares / light) / picture.height;
  }
};

// Circles of 4 % of the height, of 8 % and of 16 %: 11 to 175 pixels. The limit of the default is 4 %, and greater ones
// go to coarser levels.
// Hard case: dof.picture_size
TEST_F(DofSizes, show_circles_of_one_share_of_the_picture) {
  for (const double share : {0.04, 0.08, 0.16})
    for (const double distance_m : {1.5, 12.0}) {
      // The circle is 0.5 f² |z − 3| / (N z (3 − f)) ÷ 0.024 of the height, and the focal length f is 0.012 m ÷ tan
      // 0.3.
      const double f = 0.012 / std::tan(0.3);
      const double f_number = 0.5 * f * f * std::abs(distance_m - 3.0) / (distance_m * (3.0 - f)) / 0.024 / share;
      for (const std::uint32_t lines : {270u, 540u, 1080u}) {
        DofStage stage;
        stage.view.width = stage.view.height = lines;
        stage.glow({0.0, 0.0, -distance_m}, static_cast<float>(0.004 * distance_m), vec3(5000.0f));
        stage.focus({.focus_m = 3.0f, .f_number = static_cast<float>(f_number)});
        EXPECT_NEAR(radius_of(stage.draw()) / share, 1.0, 0.05) << lines << " lines, " << distance_m << " m, " << share;
      }
    }
}

// A thin rod before the focus, as in ../shared/cases/near-blur-solid: its circle is 8 pixels, and it is 20 wide.
// Hard case: dof.near_rod
TEST_F(DofSizes, show_a_rod_before_the_focus_with_soft_edges) {
  DofStage stage;
  stage.view.width = 180;
  stage.view.height = 120;
  const double pixel_m = std::tan(0.3) / 60.0;  // 1 m away
  for (int i = -10; i <= 10; ++i)
    stage.glow({0.0, 20.0 * pixel_m * i, -1.0}, static_cast<float>(10.0 * pixel_m), vec3(0.7f));
  stage.glow({0.0, 0.0, -5.0}, 5.0f, vec3(7.0f));
  // The circle is 0.5 f² (1/1 − 1/5) / (N (1 − f/5)) ÷ 0.024 of the height, and the focal length f is 0.012 m ÷ tan
  // 0.3.
  const double f = 0.012 / std::tan(0.3);
  const double f_number = 0.5 * f * f * 0.8 / (1.0 - f / 5.0) / 0.024 * 120.0 / 8.0;
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
    stage.focus({.focus_m = 5.0f, .f_number = static_cast<float>(f_number), .bokeh = bokeh});
    const LinearPicture shown = stage.draw(), expected = stage.through_lens(256);
    for (int x = 60; x < 120; ++x) {
      const auto at = static_cast<std::size_t>(4 * (60 * 180 + x));
      EXPECT_NEAR(shown.rgba[at], expected.rgba[at], 0.05f * 6.3f) << x;
    }
  }
}

}  // namespace
}  // namespace gloam::test
