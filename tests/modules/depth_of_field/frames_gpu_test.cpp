// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/modules/depth_of_field/support/dof_stage.h"

namespace gloam::test {
namespace {

class DofFrames : public DofStageTest {
 protected:
  /// Quads before, at and behind a focus of 3 m.
  static void add_quads(DofStage& stage) {
    stage.glow({-0.4, 0.1, -1.2}, 0.08f, vec3(3.0f, 1.0f, 0.2f));
    stage.glow({0.1, 0.2, -3.0}, 0.25f, vec3(1.0f));
    for (int i = 0; i < 5; ++i) stage.glow({-1.5 + 0.7 * i, -0.6 + 0.3 * i, -9.0}, 0.15f, vec3(20.0f, 5.0f, 40.0f));
    stage.glow({0.0, 0.0, -12.0}, 6.0f, vec3(0.05f, 0.1f, 0.2f));
  }
  static std::vector<float> picture(std::unique_ptr<JobExecutor> executor, Bokeh bokeh, const char* resolution) {
    DofStage stage(std::move(executor));
    add_quads(stage);
    stage.set("dof.resolution", resolution);
    stage.focus({.focus_m = 3.0f, .f_number = 1.0f, .bokeh = bokeh});
    return stage.draw().rgba;
  }
};

TEST_F(DofFrames, are_equal_to_the_bit_when_they_are_drawn_again_with_any_number_of_threads) {
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal})
    for (const char* resolution : {"half", "full"}) {
      const std::vector<float> first = picture(make_pool_executor(1), bokeh, resolution);
      EXPECT_TRUE(first == picture(make_pool_executor(1), bokeh, resolution)) << resolution;
      EXPECT_TRUE(first == picture(make_pool_executor(4), bokeh, resolution)) << resolution;
    }
}

TEST_F(DofFrames, change_what_is_out_of_focus_only) {
  DofStage stage;
  add_quads(stage);
  const LinearPicture sharp = stage.draw();
  stage.focus({.focus_m = 3.0f, .f_number = 1.0f});
  const LinearPicture blurred = stage.draw();
  const auto pixel = [&](const LinearPicture& picture, std::uint32_t x, std::uint32_t y) {
    const float* p = picture.rgba.data() + 4 * (std::size_t{y} * picture.width + x);
    return vec3(p[0], p[1], p[2]);
  };
  // The middle of the quad at the focus: 0.1 m to the right of and 0.2 m above the axis.
  const double scale = 32.0 / std::tan(0.3) / 3.0;
  const auto x = static_cast<std::uint32_t>(48.0 + 0.1 * scale), y = static_cast<std::uint32_t>(32.0 - 0.2 * scale);
  EXPECT_EQ(pixel(blurred, x, y), pixel(sharp, x, y));
  EXPECT_FALSE(blurred.rgba == sharp.rgba);
}

TEST_F(DofFrames, of_captures_are_in_focus) {
  DofStage stage;
  add_quads(stage);
  stage.view.purpose = ViewPurpose::capture;
  const std::vector<float> sharp = stage.draw().rgba;
  stage.focus({.focus_m = 3.0f, .f_number = 1.0f});
  EXPECT_TRUE(stage.draw().rgba == sharp);
}

// Hard case: dof.f_number_0, dof.focus_near_plane, dof.focus_infinity
TEST_F(DofFrames, of_extreme_lenses_are_finite) {
  DofStage stage;
  add_quads(stage);
  for (const DepthOfField& values :
       {DepthOfField{.focus_m = 3.0f, .f_number = 0.0f},
        DepthOfField{.focus_m = std::numeric_limits<float>::infinity(), .f_number = 1.0f},
        DepthOfField{.focus_m = 0.1f, .f_number = 1.0f}, DepthOfField{.focus_m = 1e-6f, .f_number = 0.0f},
        DepthOfField{.focus_m = 1e6f, .f_number = 0.0f}})
    for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal}) {
      DepthOfField shown = values;
      shown.bokeh = bokeh;
      stage.focus(shown);
      std::size_t wrong = 0;
      for (const float value : stage.draw().rgba) wrong += std::isfinite(value) && value >= 0.0f ? 0 : 1;
      EXPECT_EQ(wrong, 0u) << values.focus_m << ", " << values.f_number;
    }
}

// Hard case: dof.size_1x1
TEST_F(DofFrames, of_one_pixel_are_drawn) {
  DofStage stage;
  add_quads(stage);
  stage.view.width = stage.view.height = 1;
  stage.focus({.focus_m = 3.0f, .f_number = 1.0f});
  for (const float value : stage.draw().rgba) EXPECT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace gloam::test
