// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <vector>

#include "engine/render/camera/light_scale.h"
#include "modules/depth_of_field/components.h"
#include "modules/fog/components.h"
#include "modules/lighting/display/tone_reference.h"
#include "tests/modules/lighting/lit_scene.h"

namespace gloam {
namespace {

/// Scenes whose light and exposure change together: all pictures are one picture.
struct LightScale : test::LitSceneTest {
  static constexpr int kFirstEv = -10, kLastEv = 20;

  static float factor(int ev) { return std::exp2(static_cast<float>(ev)); }

  /// The picture of the scene at an exposure value. make: fills a world whose light is multiplied by `factor(ev)`.
  template <class Make>
  Picture picture_at(int ev, const Make& make) {
    return picture_of(make, ev, static_cast<float>(ev));
  }
  /// The same with light of factor(k), and at an exposure of its own: automatic if it is none.
  template <class Make>
  Picture picture_of(const Make& make, int k, std::optional<float> exposure_ev100) {
    World fresh;
    renderer->prepare_world(fresh);
    auto& sky = fresh.resource<SceneEnvironment>();
    sky.has_sky = true;
    sky.has_exposure = exposure_ev100.has_value();
    sky.exposure_ev100 = exposure_ev100.value_or(0.0f);
    test::SceneMaker maker(fresh);
    make(fresh, maker, factor(k));
    draw(fresh, settings);
    Picture picture = test::value_of(renderer->read_picture(settings.id));
    light_of_last_ = linear();
    renderer->release_world(fresh);
    return picture;
  }
  static int greatest_difference(const Picture& a, const Picture& b) {
    int greatest = 0;
    for (std::size_t i = 0; i < a.rgba.size(); ++i) greatest = std::max(greatest, std::abs(int{a.rgba[i]} - b.rgba[i]));
    return greatest;
  }
  template <class Make>
  void expect_one_picture(const Make& make) {
    const Picture expected = picture_at(3, make);
    const LinearPicture light = light_of_last_;
    for (int ev = kFirstEv; ev <= kLastEv; ++ev) {
      SCOPED_TRACE(ev);
      EXPECT_LE(greatest_difference(picture_at(ev, make), expected), 1);
      for (std::size_t i = 0; i < light.rgba.size(); ++i) {
        const float wanted = light.rgba[i] * (i % 4 == 3 ? 1.0f : factor(ev - 3));
        ASSERT_NEAR(light_of_last_.rgba[i], wanted, 2e-3f * wanted) << i;
      }
    }
  }

  /// Draws the scene with all light times 2^k at automatic exposure: the picture is that of the exposure which
  /// metering in double precision gives for the light of one scene times 2^k. Five passes may round dark light to
  /// multiples of 6e-8; at the greatest automatic exposure, 300, that is a third of a step of the picture.
  template <class Make>
  void expect_metered_pictures(const Make& make) {
    static_cast<void>(picture_at(3, make));
    const LinearPicture base = light_of_last_;
    for (int k = -10; k <= 24; ++k) {
      SCOPED_TRACE(k);
      LinearPicture wanted = base;
      for (std::size_t i = 0; i < base.rgba.size(); ++i)
        if (i % 4 != 3) wanted.rgba[i] *= factor(k - 3);
      const double ev = -std::log2(1.2 * metered_exposure(wanted));
      const Picture expected = picture_of(make, k, static_cast<float>(ev));
      EXPECT_LE(greatest_difference(picture_of(make, k, std::nullopt), expected), 2);
      for (std::size_t i = 0; i < base.rgba.size(); ++i)
        ASSERT_NEAR(light_of_last_.rgba[i], wanted.rgba[i], 2e-3f * wanted.rgba[i] + 3e-7f) << i;
    }
  }

  static Entity sun(World& lit, float lux) {
    Light what;
    what.kind = LightKind::directional;
    what.intensity = lux;
    dmat4 matrix(1.0);
    matrix[2] = dvec4(glm::normalize(dvec3(0.3, 0.8, 0.6)), 0.0);
    matrix[0] = dvec4(glm::normalize(glm::cross(dvec3(0.0, 1.0, 0.0), dvec3(matrix[2]))), 0.0);
    matrix[1] = dvec4(glm::cross(dvec3(matrix[2]), dvec3(matrix[0])), 0.0);
    return lit.create(what, WorldTransform{matrix});
  }

  /// A grey card under a sun.
  static void make_card(World& lit, test::SceneMaker& maker, float factor) {
    maker.draw(maker.mesh(test::quad(0.6f, maker.material(exact_material(141, 141, 141, 255, 0)))));
    lit.resource<SceneEnvironment>().sky_horizon = vec3(0.3f, 0.4f, 0.5f) * factor;
    sun(lit, 4.0f * factor);
  }

  /// Emission of less than 255 times white, which all exposures hold, a lamp, metal, fog and a lens. settings: get the
  /// camera.
  static void make_lamps(World& lit, test::SceneMaker& maker, float factor, ViewSettings& settings) {
    auto& sky = lit.resource<SceneEnvironment>();
    sky.sky_zenith = vec3(0.05f, 0.1f, 0.3f) * factor;
    sky.sky_horizon = vec3(0.2f, 0.15f, 0.1f) * factor;
    Material glow = exact_material(0, 0, 0, 255, 0);
    glow.emissive = vec3(20.0f, 9.0f, 0.4f) * factor;
    maker.draw(maker.mesh(test::quad(50.0f, maker.material(exact_material(120, 140, 160, 40, 255)))));
    maker.draw(maker.mesh(test::quad(0.2f, maker.material(glow))), glm::translate(dmat4(1.0), dvec3(0.4, 0.3, 0.9)));
    Light lamp;
    lamp.intensity = 3.0f * factor;
    lamp.width_m = 0.2f;
    lit.create(lamp, WorldTransform{glm::translate(dmat4(1.0), dvec3(-0.5, 0.6, 1.1))});
    lit.create(Fog{.density = 0.05f, .color = vec3(0.1f, 0.2f, 0.3f) * factor});
    Camera lens;
    lens.fov_y = settings.camera.fov_y;
    settings.camera_entity =
        lit.create(lens, WorldTransform{settings.world_from_camera}, DepthOfField{.focus_m = 1.5f, .f_number = 0.5f});
  }

  LinearPicture light_of_last_;
};

// Hard case: selftest.exposure
TEST_F(LightScale, of_a_grey_card_under_a_sun_follows_the_exposure) { expect_one_picture(make_card); }

TEST_F(LightScale, of_emission_lamps_metal_fog_and_lens_follows_the_exposure) {
  expect_one_picture(
      [this](World& lit, test::SceneMaker& maker, float factor) { make_lamps(lit, maker, factor, settings); });
}

TEST_F(LightScale, of_a_grey_card_at_automatic_exposure_follows_the_sun) { expect_metered_pictures(make_card); }

TEST_F(LightScale, of_emission_lamps_metal_fog_and_lens_at_automatic_exposure_follows_their_light) {
  expect_metered_pictures(
      [this](World& lit, test::SceneMaker& maker, float factor) { make_lamps(lit, maker, factor, settings); });
}

TEST_F(LightScale, of_emission_that_fills_the_picture_at_automatic_exposure_is_metered) {
  expect_metered_pictures([](World& lit, test::SceneMaker& maker, float factor) {
    lit.resource<SceneEnvironment>().sky_horizon = vec3(1e-3f) * factor;
    for (int i = 0; i < 3; ++i) {
      Material glow = exact_material(0, 0, 0, 255, 0);
      glow.emissive = vec3(2.0f, 3.0f, 1.0f) * (factor * std::exp2(static_cast<float>(2 * i)));
      maker.draw(maker.mesh(test::quad(50.0f / static_cast<float>(1 << 5 * i), maker.material(glow))),
                 glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 0.1 * i)));
    }
  });
}

TEST_F(LightScale, of_bright_light_is_white_and_not_grey) {
  // A sun of 130,000 lux at EV 15, and more: white is shown as white, and the brightest light is finite.
  for (const int ev : {15, 20, 30}) {
    SCOPED_TRACE(ev);
    const Picture picture = picture_at(ev, [](World& lit, test::SceneMaker& maker, float factor) {
      Material glow = exact_material(0, 0, 0, 255, 0);
      glow.emissive = vec3(1e9f * std::max(factor / 32768.0f, 1.0f));
      maker.draw(maker.mesh(test::quad(50.0f, maker.material(glow))));
      sun(lit, 4.0f * factor);
    });
    for (std::size_t i = 0; i < picture.rgba.size(); ++i) ASSERT_GE(int{picture.rgba[i]}, 254) << i;
    for (const float value : light_of_last_.rgba) ASSERT_TRUE(std::isfinite(value));
  }
}

TEST_F(LightScale, is_one_at_ordinary_exposures_and_a_power_of_two_at_all) {
  SceneEnvironment sky;
  EXPECT_EQ(light_scale(sky), 1.0f);
  sky.has_exposure = true;
  for (float ev = -100.0f; ev <= 100.0f; ev += 0.37f) {
    sky.exposure_ev100 = ev;
    const float scale = light_scale(sky);
    int exponent = 0;
    EXPECT_EQ(std::frexp(scale, &exponent), 0.5f) << ev;
    if (ev >= -2.0f && ev <= 7.5f) {
      EXPECT_EQ(scale, 1.0f) << ev;
    }
    const double white = 1.2 * std::exp2(static_cast<double>(ev)) * static_cast<double>(scale);
    EXPECT_GE(white, 0.25) << ev;
    EXPECT_LE(white, 256.0) << ev;
  }
}

TEST_F(LightScale, at_automatic_exposure_is_one_for_ordinary_light) {
  World lit;
  renderer->prepare_world(lit);
  lit.resource<SceneEnvironment>().sky_horizon = vec3(12000.0f);
  test::SceneMaker maker(lit);
  Material glow = exact_material(0, 0, 0, 255, 0);
  glow.emissive = vec3(20000.0f);
  maker.draw(maker.mesh(test::quad(1.0f, maker.material(glow))));
  Light lamp;
  lamp.intensity = 100000.0f;
  lit.create(lamp, WorldTransform{});
  sun(lit, 130000.0f);
  const SceneBrightness bright = scene_brightness(lit);
  EXPECT_NEAR(bright.lit, 130000.0 / 3.14159265, 1.0);
  EXPECT_EQ(bright.emitted, 20000.0);
  EXPECT_EQ(light_scale(bright), 1.0f);
  EXPECT_EQ(light_scale(SceneBrightness{}), 1.0f);
  // Powers of two that keep both light and emission in half floats.
  for (double lit_exponent = 0.0; lit_exponent < 60.0; lit_exponent += 0.7)
    for (double more = 0.0; more < 16.0; more += 3.1) {
      const double surfaces = std::exp2(lit_exponent), emission = surfaces * std::exp2(more);
      const auto scale = static_cast<double>(light_scale(SceneBrightness{surfaces, emission}));
      int exponent = 0;
      EXPECT_EQ(std::frexp(scale, &exponent), 0.5) << surfaces;
      EXPECT_LE(emission * scale, kMostHalf * 0.75);
      EXPECT_GE(surfaces * scale, 1.0 / 256.0);
    }
  // An emitter that outshines everything leaves surfaces their precision.
  EXPECT_GE(10.0 * static_cast<double>(light_scale(SceneBrightness{10.0, 1e12})), 1.0 / 256.0);
}

TEST_F(LightScale, at_automatic_exposure_stays_while_a_lamp_flickers) {
  for (const double mean : {5e4, 1e6, 3e8}) {
    float scale = 1.0f;
    int changes = -1;  // the first one is none
    for (int frame = 0; frame < 100; ++frame) {
      const float next = light_scale(SceneBrightness{mean * (frame % 2 == 0 ? 1.3 : 0.7), 0.0}, scale);
      changes += next != scale ? 1 : 0;
      scale = next;
    }
    EXPECT_LE(changes, 0) << mean;
  }
  // A lamp that is turned off ends it.
  EXPECT_EQ(light_scale(SceneBrightness{1.0, 0.0}, light_scale(SceneBrightness{1e8, 0.0})), 1.0f);
}

}  // namespace
}  // namespace gloam
