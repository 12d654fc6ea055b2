// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "engine/math/srgb.h"
#include "modules/lighting/display/exposure.h"
#include "modules/lighting/display/tone_reference.h"
#include "tests/modules/lighting/lit_scene.h"
#include "tests/support/worse.h"

namespace gloam {
namespace {

/// A dusk sky of few steps of 8 bits, in rows that grow brighter downward.
struct DitheredPicture : test::LitSceneTest {
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(LitSceneTest::SetUp());
    if (IsSkipped()) return;
    settings = test::look_at(dvec3(0.0), dvec3(0.0, 0.35, -1.0), 96, 240);
    settings.camera.fov_y = 0.5f;
    environment().sky_zenith = vec3(0.001f, 0.0015f, 0.004f);
    environment().sky_horizon = vec3(0.02f, 0.024f, 0.04f);
    environment().has_exposure = true;
    environment().exposure_ev100 = 0.0f;
    set("lighting.tone_map", "linear");
  }
  void set(std::string_view knob, std::string_view value) { ASSERT_TRUE(renderer->knobs().set(knob, value).ok()); }

  /// The light of a channel in steps of 8 bits, not rounded.
  [[nodiscard]] static double steps(float light) {
    const double x = std::clamp(static_cast<double>(light) * static_cast<double>(exposure_from_ev100(0.0f)), 0.0, 1.0);
    return 255.0 * linear_to_srgb(x);
  }
  /// Means of the green channel over each row.
  [[nodiscard]] static std::vector<double> row_means(const Picture& p) {
    std::vector<double> means(p.height, 0.0);
    for (std::size_t i = 1; i < p.rgba.size(); i += 4)
      means[i / 4 / p.width] += p.rgba[i] / static_cast<double>(p.width);
    return means;
  }
  /// The most rows in succession whose means differ by less than a tenth of what a row changes on average.
  [[nodiscard]] static int widest_band(const std::vector<double>& means) {
    const double change = std::abs(means.back() - means.front()) / static_cast<double>(means.size());
    int widest = 0, width = 0;
    for (std::size_t row = 8; row < means.size(); ++row) {
      // Two means over eight rows, a row apart: an eighth of the change over the eight rows between them.
      width = std::abs(means[row] - means[row - 8]) < 0.8 * change ? width + 1 : 0;
      widest = std::max(widest, width);
    }
    return widest;
  }
};

TEST_F(DitheredPicture, of_a_dark_gradient_has_no_bands) {
  ASSERT_NO_FATAL_FAILURE(draw());
  const int dithered = widest_band(row_means(picture()));
  const Picture again = picture();
  ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_EQ(again.rgba, picture().rgba) << "the pattern is fixed";
  set("lighting.dither", "off");
  ASSERT_NO_FATAL_FAILURE(draw());
  const int plain = widest_band(row_means(picture()));
  EXPECT_LT(dithered, 3);
  EXPECT_GE(plain, 5) << "the gradient has bands without dithering";
}

TEST_F(DitheredPicture, keeps_the_mean_of_light) {
  ASSERT_NO_FATAL_FAILURE(draw());
  const LinearPicture light = linear();
  const Picture shown = picture();
  double mean = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < shown.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    const double error = shown.rgba[i] - steps(light.rgba[i]);
    mean += error;
    worst = test::worse(worst, std::abs(error));
  }
  mean /= static_cast<double>(shown.rgba.size()) * 0.75;
  EXPECT_LT(std::abs(mean), 0.02) << "steps of 8 bits";
  EXPECT_LT(worst, 1.6);
}

// Hard case: selftest.tone_curve
TEST_F(DitheredPicture, rounds_as_the_reference) {
  ASSERT_NO_FATAL_FAILURE(draw());
  const LinearPicture light = linear();
  const Picture shown = picture();
  std::size_t apart = 0;
  for (std::uint32_t i = 0; i < shown.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    const uvec2 pixel(i / 4 % shown.width, i / 4 / shown.width);
    const int right = dithered_step(steps(light.rgba[i]) / 255.0, pixel, i % 4);
    ASSERT_LE(std::abs(shown.rgba[i] - right), 1);
    apart += shown.rgba[i] != right;
  }
  EXPECT_LT(apart, shown.rgba.size() / 200) << "only where a number in float rounds to the other side";
}

}  // namespace
}  // namespace gloam
