// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/reference/lens_reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "modules/depth_of_field/reference/lens_picture.h"
#include "tests/modules/depth_of_field/support/dof_stage.h"

namespace gloam::test {
namespace {

class LensReference : public DofStageTest {
 protected:
  /// Share of the aperture beyond a line at this distance from its centre, of a round one and of a hexagon with corners
  /// at the top and the bottom beyond an upright line. Radius 1.
  static double share_beyond(Bokeh bokeh, double distance) {
    if (bokeh == Bokeh::round) {
      const double d = std::clamp(distance, -1.0, 1.0);
      return (std::acos(d) - d * std::sqrt(1.0 - d * d)) / std::numbers::pi;
    }
    const double widest = std::sqrt(0.75), d = std::clamp(distance, -widest, widest);
    // The hexagon is 2 − 2 |x| / √3 high at x; its area is 1.5 √3.
    const auto area = [](double x) { return 2.0 * x - x * std::abs(x) / std::sqrt(3.0); };
    return (area(widest) - area(d)) / (1.5 * std::sqrt(3.0));
  }
};

TEST_F(LensReference, equals_the_pinhole_picture_in_the_plane_of_focus) {
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
    DofStage stage;
    for (int i = 0; i < 30; ++i)
      stage.glow({-0.913 + 0.347 * (i % 6), -0.617 + 0.311 * static_cast<double>(i / 6), -3.0}, 0.0731f,
                 vec3(0.3f + 0.1f * static_cast<float>(i), 1.0f, 5.0f / static_cast<float>(i + 1)));
    const LinearPicture pinhole = stage.draw();
    stage.focus({.focus_m = 1.5f, .f_number = 0.5f, .bokeh = bokeh});
    EXPECT_FALSE(stage.through_lens(4).rgba == pinhole.rgba);
    stage.focus({.focus_m = 3.0f, .f_number = 0.5f, .bokeh = bokeh});
    const LinearPicture mean = stage.through_lens(64);
    ASSERT_EQ(mean.rgba.size(), pinhole.rgba.size());
    double most = 0.0;
    for (std::size_t i = 0; i < mean.rgba.size(); ++i) {
      if (i % 4 == 3) continue;
      most = std::max(most, static_cast<double>(pinhole.rgba[i]));
      ASSERT_NEAR(mean.rgba[i], pinhole.rgba[i], 1e-3f * (1.0f + pinhole.rgba[i])) << i / 4 % 96 << ", " << i / 384;
    }
    EXPECT_GT(most, 1.0);
  }
}

// An edge behind the focus: each pixel shows the part of the aperture that sees the bright side.
TEST_F(LensReference, nears_the_share_of_the_aperture_that_sees_a_bright_surface) {
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
    DofStage stage;
    stage.glow({20.0, 0.0, -9.0}, 20.0f, vec3(1.0f));  // everything to the right of the axis
    const DepthOfField values{.focus_m = 2.0f, .f_number = 0.1f, .bokeh = bokeh};
    const LinearPicture pinhole = stage.draw();
    const double bright = static_cast<double>(pinhole.rgba[4 * (32 * 96 + 90)]);
    stage.focus(values);
    const auto error = [&](std::uint32_t samples) {
      const LinearPicture mean = stage.through_lens(samples);
      const double f = 0.012 / std::tan(0.3);
      const double radius = 0.5 * f * f * 7.0 / (0.1 * 9.0 * (2.0 - f)) / 0.024 * 64.0;
      EXPECT_GT(radius, 5.0);
      double squares = 0.0;
      for (int x = 0; x < 96; ++x) {
        const double expected = bright * share_beyond(bokeh, (47.5 - x) / radius);
        const double apart = static_cast<double>(mean.rgba[static_cast<std::size_t>(4 * (32 * 96 + x))]) - expected;
        squares += apart * apart;
      }
      return std::sqrt(squares / 96.0) / bright;
    };
    const double few = error(64), many = error(256);
    EXPECT_LT(many, 0.7 * few);
    EXPECT_LT(many, 0.005);
    EXPECT_GT(few, 0.0);
  }
}

TEST_F(LensReference, is_the_frame_itself_without_a_focus_and_needs_a_frame_that_can_be_drawn_again) {
  DofStage stage;
  stage.glow({0.0, 0.0, -9.0}, 1.0f, vec3(1.0f));
  const LinearPicture pinhole = stage.draw();
  EXPECT_TRUE(stage.through_lens(4).rgba == pinhole.rgba);
  const FramePictures frame{pinhole, {}};
  const ReferenceInput fixed{.world = stage.world,
                             .view = stage.drawn_view(),
                             .knobs = stage.renderer->knobs(),
                             .frame = frame,
                             .samples = 4,
                             .executor = stage.executor()};
  EXPECT_FALSE(light_through_lens(fixed).ok());
}

TEST_F(LensReference, is_shown_in_place_of_the_frame) {
  DofStage stage;
  stage.glow({0.0, 0.0, -9.0}, 1.0f, vec3(1.0f));
  stage.focus({.focus_m = 2.0f, .f_number = 0.5f});
  const LinearPicture mean = stage.through_lens(16);
  LensPicture picture{{mean.width, mean.height, {}}};
  for (const float value : mean.rgba) picture.light.push_back(float_to_half(value));
  stage.world.set_resource(picture);
  const LinearPicture shown = stage.draw();
  for (std::size_t i = 0; i < shown.rgba.size(); ++i)
    if (i % 4 != 3) {
      ASSERT_EQ(shown.rgba[i], half_to_float(picture.light[i])) << i;
    }
}

}  // namespace
}  // namespace gloam::test
