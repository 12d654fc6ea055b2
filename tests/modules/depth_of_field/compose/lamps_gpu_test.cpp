// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/modules/depth_of_field/support/dof_stage.h"

namespace gloam::test {
namespace {

/// What a picture shows of a lamp: within a window of pixels, without the wall behind it.
struct LampDisc {
  double energy = 0.0;
  double radius = 0.0;    ///< of an even disc with the same second moment
  double flatness = 0.0;  ///< p10 / p90 within 0.8 radii
};

/// A small lamp, and a dark wall 30 m away.
class DofLamps : public DofStageTest {
 protected:
  static constexpr int kWidth = 192, kHeight = 128;
  static constexpr double kFocus_m = 3.0;

  static void place(DofStage& stage, double distance_m, double pixels, Bokeh bokeh) {
    stage.view.width = kWidth;
    stage.view.height = kHeight;
    const double pixel_m = distance_m * std::tan(0.3) / (0.5 * kHeight);
    // The corner of a pixel is on the axis. The lamp lies beside it, so its edges are no edges of pixels.
    stage.glow({0.3 * pixel_m, 0.2 * pixel_m, -distance_m}, static_cast<float>(0.5 * pixels * pixel_m), vec3(3000.0f));
    stage.glow({0.0, 0.0, -30.0}, 30.0f, vec3(0.2f));
    stage.focus({.focus_m = kFocus_m, .f_number = 0.12f, .bokeh = bokeh});
  }
  static LampDisc disc_of(const LinearPicture& picture) {
    std::vector<double> light;
    const double wall = static_cast<double>(picture.rgba[4 * (5 * kWidth + 5)]);
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4)
      light.push_back(static_cast<double>(picture.rgba[i]) - wall);
    LampDisc disc;
    for (const double value : light) disc.energy += value;
    double x = 0.0, y = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
      x += light[i] / disc.energy * static_cast<double>(i % kWidth);
      y += light[i] / disc.energy * static_cast<double>(i / kWidth);
    }
    const auto distance = [&](std::size_t i) {
      return std::hypot(static_cast<double>(i % kWidth) - x, static_cast<double>(i / kWidth) - y);
    };
    for (std::size_t i = 0; i < light.size(); ++i) squares += light[i] / disc.energy * distance(i) * distance(i);
    disc.radius = std::sqrt(2.0 * squares);
    std::vector<double> inside;
    for (std::size_t i = 0; i < light.size(); ++i)
      if (distance(i) < 0.8 * disc.radius) inside.push_back(light[i]);
    std::ranges::sort(inside);
    if (!inside.empty()) disc.flatness = inside[inside.size() / 10] / inside[inside.size() - 1 - inside.size() / 10];
    return disc;
  }
};

// Near the focus, before it and behind it; lamps of one pixel and of some. The wall has a greater circle than any of
// them.
// Hard case: dof.lamps
TEST_F(DofLamps, are_discs_as_through_the_lens) {
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal})
    for (const char* resolution : {"half", "full"})
      for (const double distance_m : {1.5, 2.2, 3.4, 5.0, 12.0})
        for (const double pixels : {1.0, 3.0}) {
          DofStage stage;
          place(stage, distance_m, pixels, bokeh);
          stage.set("dof.resolution", resolution);
          const std::string which = std::string(bokeh == Bokeh::round ? "round, " : "hexagonal, ") + resolution + ", " +
                                    std::to_string(distance_m) + " m, " + std::to_string(pixels) + " pixels";
          const LampDisc shown = disc_of(stage.draw()), expected = disc_of(stage.through_lens(128));
          EXPECT_NEAR(shown.radius / expected.radius, 1.0, 0.1) << which << ", radius " << expected.radius;
          // A lamp of one pixel covers more or less than one sample of the picture.
          if (pixels > 1.0) {
            EXPECT_NEAR(shown.energy / expected.energy, 1.0, 0.03) << which;
          }
          if (expected.radius > 2.0 * pixels && bokeh == Bokeh::round) {
            EXPECT_GE(shown.flatness, 0.8) << which << ", through the lens " << expected.flatness;
          }
        }
}

// Hard case: dof.lamps
TEST_F(DofLamps, behind_an_object_in_focus_do_not_shine_through_it) {
  DofStage stage;
  place(stage, 12.0, 3.0, Bokeh::round);
  stage.glow({-0.5, 0.0, -kFocus_m}, 0.48f, vec3(0.5f));  // its right edge is close to the lamp
  const LinearPicture shown = stage.draw();
  for (int x = 10; x < 80; ++x) {
    const double light = static_cast<double>(shown.rgba[static_cast<std::size_t>(4 * (64 * kWidth + x))]);
    ASSERT_LT(light, 1.0) << x;
  }
}

}  // namespace
}  // namespace gloam::test
