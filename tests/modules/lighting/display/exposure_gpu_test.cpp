// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <cmath>

#include "modules/lighting/display/exposure.h"
#include "modules/lighting/display/tone_reference.h"
#include "tests/modules/lighting/lit_scene.h"

namespace gloam {
namespace {

/// A sky whose light changes between frames.
struct ExposureOfFrames : test::LitSceneTest {
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(LitSceneTest::SetUp());
    if (IsSkipped()) return;
    set("lighting.tone_map", "linear");
    set("lighting.dither", "off");
    settings.camera.fov_y = 2.4f;
    set_sky(1.0f);
    dt(0.1);
  }
  SceneEnvironment& environment() { return world.resource<SceneEnvironment>(); }
  void set(std::string_view knob, std::string_view value) { ASSERT_TRUE(renderer->knobs().set(knob, value).ok()); }
  void set_sky(float factor) {
    environment().has_sky = true;
    environment().sky_zenith = factor * vec3(2.0f, 1.0f, 3.0f);
    environment().sky_horizon = factor * vec3(1.0f, 0.9f, 3.0f);
    environment().sky_ground = factor * vec3(0.3f, 0.2f, 0.1f);
  }
  void dt(double dt_s) { world.resource<SceneClock>().dt_s = dt_s; }
  [[nodiscard]] double right_exposure() { return metered_exposure(linear()); }
  /// Checks that the last frame has this exposure, to one step of the picture in each of its pixels.
  void expect_exposure(double exposure) {
    const LinearPicture light = linear();
    const Picture shown = picture();
    int between = 0;
    for (std::size_t i = 0; i < shown.rgba.size(); ++i) {
      if (i % 4 == 3) continue;
      const double expected = 255.0 * linear_to_srgb(std::min(static_cast<double>(light.rgba[i]) * exposure, 1.0));
      ASSERT_NEAR(shown.rgba[i], expected, 1.0) << "byte " << i << ", light " << light.rgba[i];
      between += shown.rgba[i] > 20 && shown.rgba[i] < 250 ? 1 : 0;
    }
    EXPECT_GT(between, 100) << "a picture of black and white shows no exposure";
  }
};

TEST_F(ExposureOfFrames, that_are_metered_follows_the_light_at_once) {
  set("lighting.exposure", "metered");
  for (const float factor : {1.0f, 30.0f, 0.1f, 1e4f, 1e-3f}) {
    set_sky(factor);
    ASSERT_NO_FATAL_FAILURE(draw());
    expect_exposure(right_exposure());
  }
}

TEST_F(ExposureOfFrames, that_are_metered_comes_before_that_of_the_scene) {
  environment().has_exposure = true;
  environment().exposure_ev100 = -8.0f;
  set("lighting.exposure", "metered");
  ASSERT_NO_FATAL_FAILURE(draw());
  expect_exposure(right_exposure());
  set("lighting.exposure", "fixed");
  environment().exposure_ev100 = 0.5f;
  ASSERT_NO_FATAL_FAILURE(draw());
  expect_exposure(static_cast<double>(exposure_from_ev100(0.5f)));
}

TEST_F(ExposureOfFrames, that_adapt_goes_the_way_of_its_time_constants) {
  set("lighting.exposure", "adapting");
  ASSERT_NO_FATAL_FAILURE(draw());
  double exposure = right_exposure();
  expect_exposure(exposure);  // the first frame has the right one
  for (const auto& [factor, time_constant_s] : {std::pair(8.0f, kToBrightS), std::pair(0.2f, kToDarkS)}) {
    set_sky(factor);
    for (int frame = 0; frame < 8; ++frame) {
      const double dt_s = frame == 3 ? 0.0 : (frame == 5 ? 0.7 : 0.1);
      dt(dt_s);
      ASSERT_NO_FATAL_FAILURE(draw());
      const double right = right_exposure();
      exposure = right * std::pow(exposure / right, std::exp(-dt_s / time_constant_s));
      expect_exposure(exposure);
    }
  }
  // The way does not depend on the number of frames.
  dt(1000.0);
  ASSERT_NO_FATAL_FAILURE(draw());
  expect_exposure(right_exposure());
}

TEST_F(ExposureOfFrames, that_adapt_stays_in_a_frame_that_is_drawn_again) {
  set("lighting.exposure", "adapting");
  ASSERT_NO_FATAL_FAILURE(draw());
  set_sky(8.0f);
  dt(0.3);
  ASSERT_NO_FATAL_FAILURE(draw());
  const Picture before = picture();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(renderer->pick(world, settings.id, 10, 10).ok());
  EXPECT_EQ(picture().rgba, before.rgba);
  const double right = right_exposure();
  ASSERT_NO_FATAL_FAILURE(draw());
  const double start = metered_exposure([&] {
    LinearPicture light = linear();
    for (float& value : light.rgba) value /= 8.0f;
    return light;
  }());
  expect_exposure(right * std::pow(start / right, std::exp(-0.6 / kToBrightS)));
}

TEST_F(ExposureOfFrames, is_counted) {
  const auto counted = [&] { return renderer->report().counters.at("lighting.exposure_ev100"); };
  environment().has_exposure = true;
  environment().exposure_ev100 = 2.5f;
  ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_EQ(counted(), 2.5);
  for (const char* mode : {"metered", "fixed"}) {
    environment().has_exposure = false;
    set("lighting.exposure", mode);
    for (int frame = 0; frame < 4; ++frame) ASSERT_NO_FATAL_FAILURE(draw());
    EXPECT_NEAR(counted(), -std::log2(1.2 * right_exposure()), 0.01) << mode;
  }
  // One that was metered once, in an earlier frame and for another camera, too.
  const double first = counted();
  ViewSettings other = settings;
  other.camera_entity = world.create();
  set_sky(8.0f);
  for (int frame = 0; frame < 4; ++frame) ASSERT_NO_FATAL_FAILURE(draw(world, other));
  EXPECT_NEAR(counted(), -std::log2(1.2 * right_exposure()), 0.01);
  ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_EQ(counted(), first);
}

TEST_F(ExposureOfFrames, of_light_that_is_no_number_stays_a_number) {
  set("lighting.exposure", "adapting");
  const float wrong[] = {0.0f, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 1e30f};
  for (const float factor : wrong) {
    set_sky(factor);
    ASSERT_NO_FATAL_FAILURE(draw());
    set_sky(1.0f);
    dt(1000.0);
    ASSERT_NO_FATAL_FAILURE(draw());
    expect_exposure(right_exposure());
  }
}

}  // namespace
}  // namespace gloam
