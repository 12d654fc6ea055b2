// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/selftest/scenes.h"

#include <algorithm>

#include "engine/core/assert.h"

namespace gloam {
namespace {

using Json = TestScene::Json;

void add_camera(TestScene& scene) { scene.camera({0.3, 1.6, 3.2}, turned_about(0, -0.4)); }

/// A slab, a thin pole and a sheet close above the floor.
void add_things(TestScene& scene) {
  const std::size_t gray = scene.material(dvec3(0.5)), red = scene.material({0.6, 0.3, 0.2}, 0.5);
  scene.quad(6.0, gray);
  scene.box({0.4, 0.5, 0.3}, red, {-0.7, 0.5, 0.1}, turned_about(1, 0.4));
  scene.box({0.03, 0.8, 0.03}, red, {0.6, 0.8, -0.4});
  scene.box({0.3, 0.002, 0.2}, gray, {0.8, 0.05, 0.7});
}

TestScene with_things(const dvec3& sky = dvec3(0.0), double exposure = 3.0) {
  TestScene scene(sky, exposure);
  add_things(scene);
  add_camera(scene);
  return scene;
}

void add_lamp(TestScene& scene) {
  scene.light("point", {0.2, 2.1, 0.9}, 60.0, {{"range", 9.0}}, {{"gloam.light.width", 0.4}});
}

TestScene lamp() {
  TestScene scene = with_things();
  add_lamp(scene);
  return scene;
}

TestScene spot() {
  TestScene scene = with_things(dvec3(0.0), 5.0);
  const Json cone = {{"outerConeAngle", 0.8}, {"innerConeAngle", 0.72}};
  scene.light("spot", {0.4, 2.4, 0.4}, 300.0, {{"range", 8.0}, {"spot", cone}}, {{"gloam.light.width", 0.1}});
  return scene;
}

TestScene sun() {
  TestScene scene = with_things({0.2, 0.3, 0.4}, 4.0);
  scene.light("directional", dvec3(0.0), 30.0, Json::object(), Json::object(), turned_about(0, -0.9));
  return scene;
}

TestScene closeup() {
  TestScene scene({0.0, 0.0, 0.0}, 5.0);
  const std::size_t gray = scene.material(dvec3(0.5)), red = scene.material({0.6, 0.3, 0.2}, 0.5);
  scene.quad(6.0, gray);
  scene.box({0.3, 0.5, 0.2}, red, {-0.4, 0.5, 0.3}, turned_about(1, 0.4), {{"gloam.closeup", true}});
  scene.box({0.03, 0.8, 0.03}, red, {0.6, 0.8, -0.4});
  add_camera(scene);
  const Json cone = {{"outerConeAngle", 0.8}, {"innerConeAngle", 0.72}};
  scene.light("spot", {0.4, 2.4, 0.4}, 300.0, {{"range", 8.0}, {"spot", cone}}, {{"gloam.light.width", 0.1}});
  scene.light("directional", dvec3(0.0), 10.0, Json::object(), Json::object(), turned_about(0, -0.9));
  return scene;
}

TestScene fog() {
  TestScene scene({0.3, 0.4, 0.5}, 3.0);
  add_things(scene);
  add_camera(scene);
  add_lamp(scene);
  scene.node(dvec3(0.0), {{"gloam.fog.density", 0.15}, {"gloam.fog.color", {1.0, 1.5, 2.0}}});
  return scene;
}

TestScene lens() {
  TestScene scene;
  add_things(scene);
  const std::size_t white = scene.material(dvec3(0.9));
  for (int i = 0; i < 4; ++i) scene.box(dvec3(0.04), white, {-0.3 + 0.35 * i, 0.9, 1.9 - 0.4 * i});
  scene.camera({0.3, 1.3, 2.7}, turned_about(0, -0.4), 0.8, 0.05,
               {{"gloam.dof.focus", 1.0}, {"gloam.dof.f_number", 0.1}});
  add_lamp(scene);
  return scene;
}

TestScene puddle() {
  TestScene scene = with_things({0.3, 0.4, 0.6}, 4.0);
  const std::size_t wet = scene.material(dvec3(0.1), 0.05, {{"gloam.reflectivity", 0.8}});
  scene.quad(1.5, wet, {0.0, 0.002, 0.5});
  add_lamp(scene);
  return scene;
}

TestScene room() {
  TestScene scene = puddle();
  scene.box({1.5, 0.8, 0.02}, scene.material({0.7, 0.2, 0.1}), {0.0, 0.8, -2.0});
  scene.node({0.0, 0.8, -1.975}, {{"gloam.ibr_proxy.size", {3.0, 1.6}}});
  scene.node({0.0, 1.0, 0.0}, {{"gloam.ibr_room.size", {8.0, 4.0, 8.0}}});
  scene.node({0.0, 1.0, 0.5}, {{"gloam.cube_probe.size", {8.0, 4.0, 8.0}}, {"gloam.cube_probe.resolution", 32}});
  return scene;
}

TestScene glass() {
  TestScene scene = lamp();
  const auto sheet = [&](double alpha, const dvec3& at, const dquat& rotation) {
    const std::size_t blue = scene.material({0.2, 0.5, 0.7}, 0.3);
    scene.blend(blue, alpha);
    scene.quad(0.5, blue, at, rotation);
  };
  sheet(0.4, {0.2, 0.7, 1.2}, turned_about(0, 90.0 * kOneDegree));
  sheet(0.6, {-0.3, 0.01, 0.9}, turned_about(1, 0.3));
  return scene;
}

TestScene smoke() {
  TestScene scene = with_things({0.4, 0.5, 0.7}, 3.0);
  add_lamp(scene);
  scene.node({0.2, 0.1, 0.6}, {{"gloam.particles", "smoke"},
                               {"gloam.particles.rate", 30},
                               {"gloam.particles.lifetime", 2.5},
                               {"gloam.particles.size", 0.25},
                               {"gloam.particles.speed", 0.4},
                               {"gloam.particles.box", {0.3, 0.05, 0.3}}});
  return scene;
}

TestScene lawn() {
  TestScene scene({0.3, 0.4, 0.6}, 3.0);
  scene.quad(0.7, scene.material({0.3, 0.25, 0.2}), dvec3(0.0), TestScene::kNoRotation,
             {{"gloam.grass.density", 700},
              {"gloam.grass.height", {0.35, 0.05}},
              {"gloam.grass.width", 0.01},
              {"gloam.grass.max_distance", 9.0}});
  scene.light("point", {0.4, 1.4, 0.5}, 30.0, {{"range", 6.0}});
  scene.camera({0.2, 0.8, 1.5}, turned_about(0, -0.4));
  scene.node({2.0, 1.0, -1.0}, {{"gloam.wind.velocity", {6.0, 0.0, 2.0}}, {"gloam.wind.gust", 0.6}});
  scene.node({-0.35, 0.1, 0.0}, {{"gloam.collider", "sphere"}, {"gloam.collider.radius", 0.25}});
  return scene;
}

const std::vector<EffectScene>& scenes() {
  static const std::vector<EffectScene> all = {
      {.name = "lamp", .effect = "shadows of a lamp", .make = &lamp, .quick = true},
      {.name = "spot", .effect = "shadows of a spot light", .make = &spot},
      {.name = "sun", .effect = "shadows of a sun", .make = &sun, .quick = true},
      {.name = "closeup", .effect = "close-up shadows", .make = &closeup, .quick = true},
      {.name = "fog", .effect = "fog", .make = &fog},
      {.name = "lens", .effect = "depth of field", .make = &lens},
      {.name = "puddle", .effect = "reflections in screen space", .make = &puddle, .quick = true},
      {.name = "room",
       .effect = "reflections from proxies and probes",
       .make = &room,
       .knobs = {{"reflections.tiers", "ibr+cube"}},
       .symmetric = false},
      {.name = "glass", .effect = "blended surfaces", .make = &glass},
      {.name = "smoke", .effect = "lit particles", .make = &smoke, .time_s = 3.0, .symmetric = false, .moves = true},
      {.name = "lawn",
       .effect = "grass in the wind",
       .make = &lawn,
       .frames = 20,
       .symmetric = false,
       .moves = true,
       .quick = true},
  };
  return all;
}

}  // namespace

std::span<const EffectScene> effect_scenes() { return scenes(); }

const EffectScene& effect_scene(std::string_view name) {
  const auto found = std::ranges::find(scenes(), name, &EffectScene::name);
  GLOAM_ASSERT(found != scenes().end(), "an effect scene has this name");
  return *found;
}

TestScene bare_floor() {
  TestScene scene;
  scene.quad(3.0, scene.material(dvec3(0.5)));
  scene.camera({0.0, 2.2, 2.4}, turned_about(0, -0.75));
  return scene;
}

}  // namespace gloam
