// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "engine/math/srgb.h"
#include "engine/render/readback/capture.h"
#include "modules/lighting/display/exposure.h"
#include "modules/lighting/display/tone_reference.h"
#include "tests/modules/lighting/lit_scene.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

double curve(const std::string& name, double x) {
  double shown = x;
  if (name == "filmic") shown = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  if (name == "reinhard") shown = x / (1.0 + x);
  return std::clamp(shown, 0.0, 1.0);
}

struct PictureOfLight : test::LitSceneTest {
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(LitSceneTest::SetUp());
    if (IsSkipped()) return;
    settings.camera.fov_y = 2.4f;  // much sky, so that every value of its gradient occurs
    set_sky(1.0f);
    set("lighting.dither", "off");  // pictures are compared with the curves to one step; dithering has its own tests
  }
  void set(std::string_view knob, std::string_view value) { ASSERT_TRUE(renderer->knobs().set(knob, value).ok()); }
  void set_sky(float factor) {
    environment().sky_zenith = factor * vec3(8.0f, 0.02f, 0.5f);
    environment().sky_horizon = factor * vec3(0.0f, 0.9f, 3.0f);
    environment().sky_ground = factor * vec3(0.3f, 0.002f, 0.0f);
  }
  /// Checks a picture's bytes against linear light mapped through a curve.
  static void expect_shown(const LinearPicture& light, std::span<const std::uint8_t> bytes, const std::string& name,
                           double exposure) {
    ASSERT_EQ(bytes.size(), light.rgba.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const double expected =
          i % 4 == 3 ? 1.0 : linear_to_srgb(curve(name, static_cast<double>(light.rgba[i]) * exposure));
      ASSERT_NEAR(bytes[i], 255.0 * expected, 1.0) << name << " at byte " << i << ", light " << light.rgba[i];
    }
  }
};

TEST_F(PictureOfLight, follows_the_curves) {
  environment().has_exposure = true;
  for (const float ev : {-2.0f, 0.0f, 3.0f}) {
    environment().exposure_ev100 = ev;
    for (const char* name : {"filmic", "reinhard", "linear"}) {
      ASSERT_TRUE(renderer->knobs().set("lighting.tone_map", name).ok());
      ASSERT_NO_FATAL_FAILURE(draw());
      expect_shown(linear(), picture().rgba, name, static_cast<double>(exposure_from_ev100(ev)));
    }
  }
}

TEST_F(PictureOfLight, follows_the_curve_that_mixes_channels) {
  environment().has_exposure = true;
  set("lighting.tone_map", "agx");
  for (const float ev : {-2.0f, 0.0f, 3.0f})
    for (const char* table : {"exact", "1024"}) {
      set("lighting.tone_map_table", table);
      environment().exposure_ev100 = ev;
      ASSERT_NO_FATAL_FAILURE(draw());
      const LinearPicture light = linear();
      const Picture shown = picture();
      for (std::size_t i = 0; i < shown.rgba.size(); i += 4) {
        const float* at = &light.rgba[i];
        const dvec3 right =
            tone_mapped(ToneCurve::agx, dvec3(at[0], at[1], at[2]) * static_cast<double>(exposure_from_ev100(ev)));
        for (int c = 0; c < 3; ++c)
          ASSERT_NEAR(shown.rgba[i + static_cast<std::size_t>(c)], 255.0 * linear_to_srgb(right[c]), 1.0)
              << table << " " << ev;
      }
    }
}

TEST_F(PictureOfLight, is_white_or_black_at_the_ends_of_the_exposures) {
  environment().has_exposure = true;
  set_sky(1e4f);
  environment().sky_horizon = environment().sky_ground = environment().sky_zenith = vec3(6e4f);
  for (const char* dither : {"off", "on"})
    for (const char* name : {"filmic", "reinhard", "linear", "agx"}) {
      set("lighting.dither", dither);
      set("lighting.tone_map", name);
      for (const auto& [ev, byte] : {std::pair(-100.0f, 255), std::pair(100.0f, 0)}) {
        environment().exposure_ev100 = ev;
        ASSERT_NO_FATAL_FAILURE(draw());
        const Picture shown = picture();
        for (std::size_t i = 0; i < shown.rgba.size(); ++i)
          // Half floats end at 2 · 10⁵ times white, which reinhard maps to 254.999: dithering keeps that mean.
          ASSERT_NEAR(shown.rgba[i], i % 4 == 3 ? 255 : byte, byte / 255) << name << " " << ev << ", dither " << dither;
      }
    }
}

TEST_F(PictureOfLight, is_the_same_in_a_target_that_does_not_encode) {
  environment().has_exposure = true;
  set("lighting.dither", "on");
  ASSERT_NO_FATAL_FAILURE(draw());
  const Picture own = picture();
  gpu::Device& device = *test::shared_device();
  for (const gpu::Format format : {gpu::Format::rgba8_unorm, gpu::Format::rgba8_srgb}) {
    const gpu::ImageHandle image = test::value_of(
        device.create_image({.name = "target",
                             .module = "test",
                             .format = format,
                             .width = settings.width,
                             .height = settings.height,
                             .usage = gpu::ImageUsage::color_target | gpu::ImageUsage::transfer_source}));
    const ViewRequest request{settings, {.image = image, .after = gpu::Access::transfer_read}};
    ASSERT_TRUE(renderer->render(world, std::span(&request, 1)).ok());
    ASSERT_TRUE(renderer->wait().ok());
    const auto bytes = test::value_of(read_image_now(device, image));
    ASSERT_EQ(bytes.size(), own.rgba.size());
    for (std::size_t i = 0; i < bytes.size(); ++i) ASSERT_NEAR(std::to_integer<int>(bytes[i]), own.rgba[i], 1) << i;
    device.destroy(image);
  }
}

TEST_F(PictureOfLight, is_metered_in_the_first_frame_and_then_fixed) {
  ASSERT_TRUE(renderer->knobs().set("lighting.tone_map", "linear").ok());
  ASSERT_NO_FATAL_FAILURE(draw());
  const double exposure = metered_exposure(linear());
  expect_shown(linear(), picture().rgba, "linear", exposure);
  const Picture first = picture();
  set_sky(0.2f);
  for (int frame = 0; frame < 3; ++frame) {
    ASSERT_NO_FATAL_FAILURE(draw());
    expect_shown(linear(), picture().rgba, "linear", exposure);
    EXPECT_NE(picture().rgba, first.rgba);
  }
  // The same camera at another size also keeps its exposure.
  settings.width = 90;
  ASSERT_NO_FATAL_FAILURE(draw());
  expect_shown(linear(), picture().rgba, "linear", exposure);
}

TEST_F(PictureOfLight, is_metered_once_a_camera_and_view) {
  ASSERT_TRUE(renderer->knobs().set("lighting.tone_map", "linear").ok());
  ASSERT_NO_FATAL_FAILURE(draw());
  set_sky(0.1f);
  ViewSettings other = settings;
  other.id = ViewId{1};
  ASSERT_NO_FATAL_FAILURE(draw(world, other));
  expect_shown(linear(1), picture(1).rgba, "linear", metered_exposure(linear(1)));
  ViewSettings followed = settings;
  followed.camera_entity = world.create(Camera{.fov_y = 2.4f}, WorldTransform{settings.world_from_camera});
  ASSERT_NO_FATAL_FAILURE(draw(world, followed));
  expect_shown(linear(), picture().rgba, "linear", metered_exposure(linear()));
}

TEST_F(PictureOfLight, is_metered_anew_for_a_world_that_was_prepared_again) {
  ASSERT_TRUE(renderer->knobs().set("lighting.tone_map", "linear").ok());
  ASSERT_NO_FATAL_FAILURE(draw());
  renderer->prepare_world(world);
  set_sky(0.1f);
  ASSERT_NO_FATAL_FAILURE(draw());
  expect_shown(linear(), picture().rgba, "linear", metered_exposure(linear()));
}

TEST_F(PictureOfLight, of_two_views_in_one_frame_is_metered_for_each) {
  ASSERT_TRUE(renderer->knobs().set("lighting.tone_map", "linear").ok());
  ViewSettings other = settings;
  other.id = ViewId{1};
  other.camera.fov_y = 0.3f;
  const ViewRequest requests[] = {{settings, {}}, {other, {}}};
  for (int frame = 0; frame < 2; ++frame) {
    ASSERT_TRUE(renderer->render(world, requests).ok());
    ASSERT_TRUE(renderer->wait().ok());
    expect_shown(linear(0), picture(0).rgba, "linear", metered_exposure(linear(0)));
    expect_shown(linear(1), picture(1).rgba, "linear", metered_exposure(linear(1)));
  }
}

TEST_F(PictureOfLight, is_exposed_for_what_is_lit_before_black) {
  set("lighting.tone_map", "linear");
  set_sky(0.0f);
  Material lamp{.base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f)};
  lamp.emissive = vec3(5.0f);
  settings.width = 240;
  settings.height = 160;
  // From most of the picture to less than a point of the coarse grid. All lit pixels have the same light.
  for (const float half : {2.5f, 0.5f, 0.06f}) {
    World dark;
    renderer->prepare_world(dark);
    test::SceneMaker maker(dark);
    maker.draw(maker.mesh(test::quad(half, maker.material(lamp))));
    ASSERT_NO_FATAL_FAILURE(draw(dark, settings));
    expect_shown(linear(), picture().rgba, "linear", metered_exposure(linear()));
    const double key = 1.03 - 2.0 / (2.0 + std::log10(5.0 + 1.0));
    const std::size_t middle = (std::size_t{settings.height} / 2 * settings.width + settings.width / 2) * 4;
    EXPECT_NEAR(picture().rgba[middle], 255.0 * linear_to_srgb(key), 1.0) << "a lamp of " << half << " m";
    renderer->release_world(dark);
  }
}

TEST_F(PictureOfLight, of_a_black_world_is_black) {
  set_sky(0.0f);
  set("lighting.dither", "on");
  ASSERT_NO_FATAL_FAILURE(draw());
  const Picture shown = picture();
  for (std::size_t i = 0; i < shown.rgba.size(); ++i) ASSERT_EQ(shown.rgba[i], i % 4 == 3 ? 255 : 0);
}

TEST_F(PictureOfLight, takes_the_scenes_exposure_before_a_metered_one) {
  ASSERT_TRUE(renderer->knobs().set("lighting.tone_map", "linear").ok());
  ASSERT_NO_FATAL_FAILURE(draw());
  const double metered = metered_exposure(linear());
  environment().has_exposure = true;
  environment().exposure_ev100 = 1.0f;
  ASSERT_NO_FATAL_FAILURE(draw());
  expect_shown(linear(), picture().rgba, "linear", static_cast<double>(exposure_from_ev100(1.0f)));
  environment().has_exposure = false;
  ASSERT_NO_FATAL_FAILURE(draw());
  expect_shown(linear(), picture().rgba, "linear", metered);
}

TEST_F(PictureOfLight, of_more_lights_than_fit_warns_once_and_counts) {
  scene.draw(scene.mesh(test::quad(5.0f, scene.material({}))));
  Light lamp;
  lamp.range_m = 4.0f;
  for (int i = 0; i < 1100; ++i) light(lamp, dvec3(0.001 * i, 0.0, 1.0));
  for (int frame = 0; frame < 3; ++frame) ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_THAT(warnings, ElementsAre(HasSubstr("the 76 least important are left out")));
  const FrameReport report = renderer->report();
  EXPECT_EQ(report.counters.at("lights.total"), 1100.0);
  EXPECT_EQ(report.counters.at("lights.visible"), 1024.0);
  EXPECT_EQ(report.counters.at("lights.dropped"), 76.0);
}

TEST_F(PictureOfLight, of_a_world_without_lights_costs_the_lights_module_nothing) {
  scene.draw(scene.mesh(test::quad(5.0f, scene.material({}))));
  const auto expect_nothing = [&] {
    const ModuleState lights = module_state("lights");
    EXPECT_FALSE(lights.demanded);
    EXPECT_EQ(lights.reason, "no light");
    EXPECT_EQ(lights.pipelines, 0u);
    EXPECT_EQ(lights.gpu_bytes, 0u);
    for (const PassTime& pass : renderer->report().passes) EXPECT_NE(pass.module, "lights") << pass.name;
    EXPECT_EQ(renderer->report().counters.count("lights.total"), 0u);
  };
  for (int frame = 0; frame < 2; ++frame) {
    ASSERT_NO_FATAL_FAILURE(draw());
    expect_nothing();
  }
  const Entity lamp = light(Light{}, dvec3(0.0, 0.0, 1.0));
  ASSERT_NO_FATAL_FAILURE(draw());
  const LinearPicture lit = linear();
  EXPECT_TRUE(module_state("lights").demanded);
  EXPECT_GT(module_state("lights").pipelines, 0u);
  EXPECT_EQ(renderer->report().counters.at("lights.visible"), 1.0);
  world.destroy(lamp);
  ASSERT_NO_FATAL_FAILURE(draw());
  EXPECT_FALSE(module_state("lights").demanded);
  for (const PassTime& pass : renderer->report().passes) EXPECT_NE(pass.module, "lights") << pass.name;
  EXPECT_NE(linear().rgba, lit.rgba) << "the light is gone";
}

TEST_F(PictureOfLight, shows_lights_that_come_and_go) {
  scene.draw(scene.mesh(test::quad(5.0f, scene.material({}))));
  environment() = {};
  std::vector<Entity> lamps;
  const auto brightness = [&] {
    draw();
    float sum = 0.0f;
    for (const float value : linear().rgba) sum += value;
    return sum;
  };
  const float none = brightness();
  for (int i = 0; i < 3; ++i) lamps.push_back(light(Light{}, dvec3(0.2 * i, 0.0, 1.0)));
  const float three = brightness();
  world.destroy(lamps[1]);
  const float two = brightness();
  for (const int i : {0, 2}) world.destroy(lamps[i]);
  EXPECT_GT(three, two);
  EXPECT_GT(two, none);
  EXPECT_EQ(brightness(), none);
}

}  // namespace
}  // namespace gloam
