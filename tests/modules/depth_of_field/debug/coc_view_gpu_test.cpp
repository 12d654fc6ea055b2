// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/debug/coc_view.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/modules/depth_of_field/support/dof_stage.h"

namespace gloam::test {
namespace {

class DofCocView : public DofStageTest {
 protected:
  /// Radius in pixels of the circle of a thin lens in a picture 64 pixels high.
  static double radius(double focus, double f_number, double z) {
    const double f = 0.012 / std::tan(0.3);
    return 0.5 * f * f * (z - focus) / (f_number * z * (focus - f)) / 0.024 * 64.0;
  }
};

TEST_F(DofCocView, shows_the_circle_of_confusion_of_each_pixel) {
  DofStage stage;
  stage.set("dof.radius", "10");  // of 64 lines: 7.1 pixels are four limits
  stage.glow({0.0, 0.0, -8.0}, 6.0f, vec3(1.0f));
  stage.glow({0.45, 0.0, -2.0}, 0.3f, vec3(1.0f));
  stage.glow({-0.25, 0.0, -1.0}, 0.15f, vec3(1.0f));
  stage.focus({.focus_m = 2.0f, .f_number = 0.5f});
  stage.view.visualizer = "dof_coc";
  static_cast<void>(stage.draw());
  const ImageBytes image = value_of(stage.renderer->read_image(stage.world, stage.view.id, "dof_coc"));
  const auto shown = [&](int x, int y) {
    std::uint16_t half = 0;
    std::memcpy(&half, image.bytes.data() + (y * 96 + x) * 8, 2);
    return static_cast<double>(half_to_float(half));
  };
  const double scale = 32.0 / std::tan(0.3);  // pixels, of a tangent
  const auto expected = [&](double z) {
    return std::clamp(radius(2.0, 0.5, z), -4.0 * 10.0 * 64.0 / 360.0, 4.0 * 10.0 * 64.0 / 360.0);
  };
  EXPECT_NEAR(shown(48, 4), expected(8.0), 4e-3);
  EXPECT_NEAR(shown(48 + static_cast<int>(0.45 / 2.0 * scale), 32), 0.0, 4e-3);
  EXPECT_NEAR(shown(48 - static_cast<int>(0.25 / 1.0 * scale), 32), expected(1.0), 4e-3);
  EXPECT_GT(expected(8.0), 1.0);
  EXPECT_LT(expected(1.0), -1.0);
}

}  // namespace
}  // namespace gloam::test
