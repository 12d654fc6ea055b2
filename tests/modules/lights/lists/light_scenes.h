// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/modules/lighting/lit_scene.h"

/// Whole frames among lights: drawn from the light lists and by looping over all lights. Both must give bit-identical
/// pictures.
namespace gloam::test {

/// A separate world with a camera.
struct LightScene {
  std::unique_ptr<World> world = std::make_unique<World>();
  SceneMaker make{*world};
  ViewSettings view;
  dvec3 origin = dvec3(0.0);  ///< world position of the stage

  Entity light(const Light& what, const dmat4& node) {
    return world->create(what, WorldTransform{glm::translate(dmat4(1.0), origin) * node});
  }
  Entity light(const Light& what, const dvec3& position, const dvec3& direction = dvec3(0.0, -1.0, 0.0)) {
    return light(what, node_towards(position, direction));
  }
  Entity draw(std::uint32_t mesh, const dmat4& node) {
    return make.draw(mesh, glm::translate(dmat4(1.0), origin) * node);
  }
  void look(const dvec3& eye, const dvec3& target, std::uint32_t width, std::uint32_t height) {
    const Camera lens = view.camera;
    view = look_at(origin + eye, origin + target, width, height);
    view.camera = lens;
  }

  [[nodiscard]] static dmat4 node_towards(const dvec3& position, const dvec3& direction) {
    const dvec3 z = -glm::normalize(direction);
    const dvec3 x = glm::normalize(glm::cross(std::abs(z.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0), z));
    return dmat4(dvec4(x, 0.0), dvec4(glm::cross(z, x), 0.0), dvec4(z, 0.0), dvec4(position, 1.0));
  }
};

[[nodiscard]] inline Light point_lamp(float intensity, float range_m = 0.0f) {
  Light light;
  light.intensity = intensity;
  light.range_m = range_m;
  light.color = vec3(1.0f, 0.8f, 0.6f);
  return light;
}

[[nodiscard]] inline Light spot_lamp(float intensity, float range_m, float outer_angle) {
  Light light = point_lamp(intensity, range_m);
  light.kind = LightKind::spot;
  light.outer_angle = outer_angle;
  light.inner_angle = 0.5f * outer_angle;
  return light;
}

class LightScenesTest : public LitSceneTest {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(LitSceneTest::SetUp());
    if (IsSkipped()) return;
    set("lights.check", "on");
    set("shadows.mode", "off");  // these tests are about lists, and shadow maps of thousands of lights take long
  }

  void set(const std::string& knob, const std::string& value) {
    const Status done = renderer->knobs().set(knob, value);
    ASSERT_TRUE(done.ok()) << done.error().message;
  }

  /// Only a camera and a sky. `origin`: world position of everything added later.
  [[nodiscard]] LightScene empty_scene(const dvec3& origin = dvec3(0.0)) const {
    LightScene scene_;
    scene_.origin = origin;
    renderer->prepare_world(*scene_.world);
    auto& sky = scene_.world->resource<SceneEnvironment>();
    sky.sky_zenith = vec3(0.02f, 0.03f, 0.06f);
    sky.sky_horizon = vec3(0.05f, 0.04f, 0.03f);
    sky.sky_ground = vec3(0.01f);
    sky.has_exposure = true;
    sky.exposure_ev100 = 2.0f;
    scene_.look(dvec3(0.6, 1.7, 5.0), dvec3(0.0, 0.7, -1.0), 97, 65);
    return scene_;
  }

  /// Ground, a back wall, boxes and a pane of glass, centred at the origin. The camera is 5 m in front.
  [[nodiscard]] LightScene stage(const dvec3& origin = dvec3(0.0)) const {
    LightScene s = empty_scene(origin);
    Material stone;
    stone.base_color = vec4(0.6f, 0.55f, 0.5f, 1.0f);
    stone.metallic = 0.1f;
    stone.roughness = 0.5f;
    const std::uint32_t material = s.make.material(stone);
    s.draw(s.make.mesh(quad(12.0f, material)), glm::rotate(dmat4(1.0), glm::radians(-90.0), dvec3(1.0, 0.0, 0.0)));
    s.draw(s.make.mesh(quad(3.0f, material)), glm::translate(dmat4(1.0), dvec3(-1.0, 2.0, -5.0)));
    const std::uint32_t cube = s.make.mesh(box(vec3(0.35f), material));
    for (const dvec3& at :
         {dvec3(-1.2, 0.35, 0.5), dvec3(0.9, 0.35, -1.0), dvec3(0.2, 1.3, -3.0), dvec3(1.2, 1.2, 4.0)})
      s.draw(cube, glm::rotate(glm::translate(dmat4(1.0), at), at.x * 3.0, dvec3(0.0, 1.0, 0.0)));
    Material glass = stone;
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color = vec4(0.3f, 0.7f, 0.5f, 0.35f);
    s.draw(s.make.mesh(quad(0.7f, s.make.material(glass))), glm::translate(dmat4(1.0), dvec3(-0.6, 1.2, 1.5)));
    return s;
  }

  struct Drawn {
    LinearPicture light;
    Picture picture;
    std::map<std::string, double> counters;
  };
  /// Draws one frame.
  [[nodiscard]] Drawn drawn(World& what, const ViewSettings& view, const std::string& culling) {
    set("lights.culling", culling);
    Drawn result;
    draw(what, view);
    if (HasFatalFailure()) return result;
    result.counters = renderer->report().counters;
    result.light = linear(view.id.value);
    result.picture = picture(view.id.value);
    return result;
  }

  static double counter(const Drawn& frame, const std::string& name) {
    const auto at = frame.counters.find(name);
    return at == frame.counters.end() ? 0.0 : at->second;
  }

  /// Checks that the picture has no NaN and the counters report no error.
  static void expect_sound(const Drawn& frame, const std::string& what) {
    for (const float value : frame.light.rgba) {
      const bool sound = std::isfinite(value) && value >= 0.0f && value <= 65504.0f;
      ASSERT_TRUE(sound) << what << ": " << value;
    }
    for (const auto& [name, value] : frame.counters) {
      EXPECT_TRUE(std::isfinite(value)) << what << ": " << name;
    }
    EXPECT_EQ(counter(frame, "lights.capacity_violations"), 0.0) << what;
    EXPECT_EQ(counter(frame, "lights.culling_errors"), 0.0) << what;
    // Each search must find no more than the one before.
    const double mask = counter(frame, "lights.per_tile_mask_mean");
    const double candidates = counter(frame, "lights.per_tile_candidates_mean");
    const double approx = counter(frame, "lights.per_tile_approx_mean");
    EXPECT_LE(candidates, mask * 1.000001) << what;
    EXPECT_LE(approx, candidates * 1.000001) << what;
    EXPECT_LE(approx, counter(frame, "lights.per_tile_group_mean") * 1.000001) << what;
    EXPECT_LE(counter(frame, "lights.per_tile_accurate_mean"), approx * 1.000001) << what;
  }

  static void expect_same(const Drawn& tiled, const Drawn& brute, const std::string& what) {
    ASSERT_EQ(tiled.light.rgba.size(), brute.light.rgba.size()) << what;
    std::size_t different = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < tiled.light.rgba.size(); ++i) {
      if (std::bit_cast<std::uint32_t>(tiled.light.rgba[i]) == std::bit_cast<std::uint32_t>(brute.light.rgba[i]))
        continue;
      if (different++ == 0) first = i;
    }
    EXPECT_EQ(different, 0u) << what << ": of " << tiled.light.rgba.size() << ", first at pixel "
                             << first / 4 % tiled.light.width << ',' << first / 4 / tiled.light.width << ": "
                             << tiled.light.rgba[first] << " from lists, " << brute.light.rgba[first]
                             << " from all lights";
    EXPECT_EQ(tiled.picture.rgba, brute.picture.rgba) << what;
  }

  /// Draws both ways and compares. Returns the tiled frame.
  Drawn expect_tiled_is_brute(LightScene& s, const std::string& what) {
    Drawn tiled = drawn(*s.world, s.view, "tiled");
    if (HasFatalFailure()) return tiled;
    const Drawn brute = drawn(*s.world, s.view, "brute");
    if (HasFatalFailure()) return tiled;
    expect_sound(tiled, what);
    expect_sound(brute, what + ", brute");
    expect_same(tiled, brute, what);
    return tiled;
  }

  /// The same, then destroys the world.
  Drawn expect_tiled_is_brute_and_release(LightScene s, const std::string& what) {
    Drawn tiled = expect_tiled_is_brute(s, what);
    renderer->release_world(*s.world);
    return tiled;
  }

  [[nodiscard]] static float brightest(const LinearPicture& picture) {
    float most = 0.0f;
    for (std::size_t i = 0; i < picture.rgba.size(); ++i)
      if (i % 4 != 3) most = std::max(most, picture.rgba[i]);
    return most;
  }

  /// Lights of all kinds over the stage.
  static void scatter(LightScene& s, int count, std::uint32_t seed, double range) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int i = 0; i < count; ++i) {
      Light light = i % 2 == 0 ? point_lamp(2.0f, static_cast<float>(range * (1.0 + 0.5 * unit(random))))
                               : spot_lamp(4.0f, static_cast<float>(range * (1.5 + 0.5 * unit(random))),
                                           static_cast<float>(0.8 + 0.77 * unit(random)));
      light.color = vec3(dvec3(0.6) + 0.4 * dvec3(unit(random), unit(random), unit(random)));
      const dvec3 position(6.0 * unit(random), 1.2 + 1.1 * unit(random), -1.0 + 6.0 * unit(random));
      s.light(light, position, dvec3(unit(random), -0.6 + unit(random), unit(random) + 1e-3));
    }
  }
};

}  // namespace gloam::test
