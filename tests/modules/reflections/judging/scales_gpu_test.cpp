// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// A scene at other scales and far from the origin shows the same picture.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include "engine/scene/units.h"
#include "tests/modules/reflections/judging/judged_scene.h"

namespace gloam::test {
namespace {

constexpr double kMostMean = 0.5;  // of 255

class SceneScales : public JudgedReflections {
 protected:
  struct Drawn {
    LinearPicture picture;
    double reflected = 0.0;  ///< mean difference from the picture without reflections, of 255
  };
  /// A floor with two roughnesses, posts, walls with proxies, a room and probes. Lengths times `scale`, moved by
  /// `place`; light on surfaces does not change. stated: the world says what its unit is (gloam.scale).
  Drawn draw_scaled(double scale, const dvec3& place, bool stated) {
    World fresh;
    renderer->prepare_world(fresh);
    if (stated) fresh.set_resource(SceneUnits{.metres_per_unit = 1.0 / scale});
    fresh.resource<SceneEnvironment>() = {
        .sky_zenith = {0.05f, 0.08f, 0.2f}, .sky_horizon = {0.1f, 0.1f, 0.12f}, .sky_ground = vec3(0.05f)};
    SceneMaker maker(fresh);
    const auto placed = [&](const dvec3& at) { return glm::translate(dmat4(1.0), place + scale * at); };
    const auto block = [&](const Material& material, const dvec3& at, const dvec3& half) {
      maker.draw(maker.mesh(box(vec3(1.0f), maker.material(material))), glm::scale(placed(at), scale * half));
    };
    const dmat4 upward = glm::rotate(dmat4(1.0), -1.57079632679489661923, dvec3(1.0, 0.0, 0.0));
    for (int i = 0; i < 2; ++i)
      maker.draw(
          maker.mesh(quad(1.0f, maker.material(mirror(i == 0 ? 0.0f : 0.25f)))),
          placed({i == 0 ? -2.0 : 2.0, 0.0, 0.0}) * upward * glm::scale(dmat4(1.0), scale * dvec3(2.0, 4.0, 1.0)));
    for (int i = 0; i < 7; ++i)
      block(glow({0.9f, 0.1f * static_cast<float>(i), 0.3f}), {-1.8 + 0.6 * i, 0.4, 0.4 * (i % 2)}, {0.05, 0.4, 0.05});
    for (int i = 0; i < 8; ++i)
      block(glow(vec3(i % 2 == 0 ? 0.7f : 0.25f, 0.4f, 0.3f)), {-3.5 + i, 1.5, -2.5}, {0.5, 1.5, 0.05});
    block(matt({0.6f, 0.5f, 0.4f}), {-4.1, 1.5, 0.0}, {0.05, 1.5, 4.0});
    const auto add_proxy = [&](const vec2& size, const dmat4& at) {
      IbrProxy quad;
      quad.size_m = size * static_cast<float>(scale);
      fresh.create(quad, WorldTransform{at});
    };
    add_proxy(vec2(8.0f, 3.0f), placed({0.0, 1.5, -2.44}));
    add_proxy(vec2(8.0f, 3.0f), glm::rotate(placed({-4.04, 1.5, 0.0}), 1.57079632679489661923, dvec3(0.0, 1.0, 0.0)));
    IbrRoom room;
    room.size_m = vec3(static_cast<float>(scale) * vec3(10.0f, 6.0f, 12.0f));
    fresh.create(room, WorldTransform{placed({0.0, 2.5, 0.0})});
    CubeProbe inside;
    inside.size_m = vec3(static_cast<float>(scale) * vec3(9.0f, 5.0f, 9.0f));
    fresh.create(inside, WorldTransform{placed({0.0, 2.4, 0.0})});
    CubeProbe global;
    global.global = true;
    fresh.create(global, WorldTransform{placed({0.0, 2.4, 0.0})});
    Light what;
    what.intensity = static_cast<float>(12.0 * scale * scale);
    what.range_m = static_cast<float>(15.0 * scale);
    dmat4 at = placed({1.0, 2.5, 1.5});
    fresh.create(what, WorldTransform{at}, ShadowCaster{.enabled = false});
    attach_captures(fresh, value_of(bake_reflections(*renderer, fresh, {.executor = executor.get(), .progress = {}})));

    ViewSettings view = look_at(scale * dvec3(0.3, 1.4, 4.0), scale * dvec3(0.0, -0.6, 0.0), 240, 136);
    view.world_from_camera[3] = dvec4(place + scale * dvec3(0.3, 1.4, 4.0), 1.0);
    view.camera.near_m = static_cast<float>(0.05 * scale);
    view.camera.orthographic = orthographic;
    if (orthographic) view.camera.far_m = static_cast<float>(50.0 * scale);  // its depth is linear
    view.camera.half_height_m = static_cast<float>(1.5 * scale);
    view.id = ViewId{++views};
    Drawn result;
    for (int i = 0; i < 3; ++i) draw(fresh, view);
    result.picture = linear(views);
    set("reflections.mode", "off");
    draw(fresh, view);
    result.reflected = mean_difference(linear(views), result.picture);
    set("reflections.mode", "tiers");
    renderer->release_world(fresh);
    return result;
  }
  /// Mean absolute difference of displayed pictures, of 255.
  [[nodiscard]] static double mean_difference(const LinearPicture& a, const LinearPicture& b) {
    double sum = 0.0;
    for (std::uint32_t y = 0; y < a.height; ++y)
      for (std::uint32_t x = 0; x < a.width; ++x) {
        const dvec3 off = glm::abs(shown_light(pixel(a, x, y)) - shown_light(pixel(b, x, y)));
        sum += 255.0 / 3.0 * (off.x + off.y + off.z);
      }
    return sum / (static_cast<double>(a.width) * a.height);
  }
  void judge(double scale, const dvec3& place, const char* tiers, bool stated) {
    set("reflections.tiers", tiers);
    auto [usual_place, missing] = usual_pictures.try_emplace({tiers, orthographic});
    if (missing) usual_place->second = draw_scaled(1.0, dvec3(0.0), false);
    const Drawn& usual = usual_place->second;
    const Drawn other = draw_scaled(scale, place, stated);
    const double difference = mean_difference(usual.picture, other.picture);
    std::printf("scale %g%s at %g m, %s: mean difference %.3f of 255 (reflections: %.1f)\n", scale,
                stated ? " (stated)" : "", glm::length(place), tiers, difference, usual.reflected);
    EXPECT_GT(usual.reflected, 3.0);
    EXPECT_LT(difference, kMostMean) << tiers;
  }

  /// Pictures at the usual scale and place, by tiers and whether the camera is orthographic.
  inline static std::map<std::pair<std::string, bool>, Drawn> usual_pictures;
  bool orthographic = false;
  std::uint32_t views = 0;
};

// A world made in code states its unit (SceneUnits). That of a file is estimated: Scale.test_mirrors_with_all_tiers_….
TEST_F(SceneScales, a_hundredth_with_its_unit_stated) {
  for (const char* tiers : {"ssr+cube", "ibr+cube", "all"}) judge(0.01, dvec3(0.0), tiers, true);
}
TEST_F(SceneScales, a_hundred_times_with_its_unit_stated) {
  for (const char* tiers : {"ssr+cube", "ibr+cube", "all"}) judge(100.0, dvec3(0.0), tiers, true);
}
TEST_F(SceneScales, an_orthographic_camera_at_a_hundredth_and_a_hundred_times) {
  orthographic = true;
  for (const double scale : {0.01, 100.0}) judge(scale, dvec3(0.0), "all", true);
}
TEST_F(SceneScales, five_kilometres_away) {
  for (const char* tiers : {"ssr+cube", "ibr+cube", "all"}) judge(1.0, dvec3(3000.0, 16.0, -4000.0), tiers, false);
}
TEST_F(SceneScales, a_hundredth_at_fifty_metres) { judge(0.01, dvec3(30.0, 0.16, -40.0), "all", true); }

}  // namespace
}  // namespace gloam::test
