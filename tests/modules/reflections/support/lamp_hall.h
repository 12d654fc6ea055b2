// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/systems.h"
#include "modules/lights/components.h"
#include "modules/reflections/bake.h"
#include "tests/modules/reflections/support/reflection_frames.h"

namespace gloam::test {

/// A hall of 24 × 12 × 5 m with a mirror floor, plastered walls with a proxy for each 6 m, a probe, and lamps.
struct LampHall : ReflectionFrames {
  std::vector<Entity> lamps;

  void SetUp() override {
    ReflectionFrames::SetUp();
    if (IsSkipped()) return;
    settings = look_at(dvec3(-10.0, 1.7, 1.0), dvec3(2.0, 0.3, -1.0), 96, 64);
    sky(vec3(0.05f));
    Material plaster;
    plaster.base_color = vec4(0.6f, 0.5f, 0.4f, 1.0f);
    plaster.metallic = 0.0f;
    plaster.roughness = 0.9f;
    plaster.reflectivity = 0.0f;
    const std::uint32_t wall = scene.material(plaster);
    Material mirror = exact_material(255, 255, 255, 0, 255);
    mirror.roughness = 0.0f;
    mirror.reflectivity = 1.0f;
    scene.draw(scene.mesh(box(vec3(12.0f, 0.1f, 6.0f), scene.material(mirror))), at(0.0, -0.1, 0.0));
    scene.draw(scene.mesh(box(vec3(12.0f, 0.1f, 6.0f), wall)), at(0.0, 5.1, 0.0));
    for (const double side : {-1.0, 1.0}) {
      scene.draw(scene.mesh(box(vec3(12.0f, 2.5f, 0.1f), wall)), at(0.0, 2.5, side * 6.1));
      scene.draw(scene.mesh(box(vec3(0.1f, 2.5f, 6.0f), wall)), at(side * 12.1, 2.5, 0.0));
    }
    add_proxies();
    probe(vec3(26.0f, 7.0f, 14.0f), {0.0, 2.5, 0.0});  // its share falls toward its faces
    IbrRoom room;
    room.size_m = vec3(24.5f, 5.5f, 12.5f);
    world.create(room, WorldTransform{at(0.0, 2.5, 0.0)});
    for (const double x : {-8.0, -3.0})
      for (const double z : {-3.0, 3.0}) lamps.push_back(lamp({x, 3.5, z}, 400.0f));
  }
  void add_proxies() {
    const double quarter = 1.57079632679489661923;
    const auto facing = [&](double angle, const dvec3& axis, const dvec3& where) {
      return glm::rotate(at(where.x, where.y, where.z), angle, axis);
    };
    const dvec3 up(0.0, 1.0, 0.0), across(1.0, 0.0, 0.0);
    for (int i = 0; i < 4; ++i) {
      const double x = -9.0 + 6.0 * i;
      proxy(vec2(6.0f, 5.0f), facing(0.0, up, {x, 2.5, -6.0}));
      proxy(vec2(6.0f, 5.0f), facing(2.0 * quarter, up, {x, 2.5, 6.0}));
      for (const double z : {-3.0, 3.0}) proxy(vec2(6.0f), facing(quarter, across, {x, 5.0, z}));
    }
    for (const double z : {-3.0, 3.0}) {
      proxy(vec2(6.0f, 5.0f), facing(quarter, up, {-12.0, 2.5, z}));
      proxy(vec2(6.0f, 5.0f), facing(-quarter, up, {12.0, 2.5, z}));
    }
  }
  Entity lamp(const dvec3& where, float candela) {
    Light what;
    what.color = vec3(1.0f, 0.8f, 0.5f);
    what.intensity = candela;
    return world.create(what, WorldTransform{at(where.x, where.y, where.z)});
  }
  /// Panels on the walls and the ceiling that shine by themselves about as brightly as the lit walls.
  void add_panels() {
    for (int i = 0; i < 4; ++i) {
      shining_box({-9.0 + 6.0 * i, 3.0, -5.98}, vec3(1.0f, 0.6f, 0.02f), {4.0f, 6.0f, 9.0f});
      shining_box({-9.0 + 6.0 * i, 2.0, 5.98}, vec3(0.8f, 0.5f, 0.02f), {9.0f, 3.0f, 2.0f});
      shining_box({-9.0 + 6.0 * i, 4.98, 0.0}, vec3(0.5f, 0.02f, 2.0f), vec3(5.0f));
    }
  }
  void capture_again() {
    auto captures =
        value_of(bake_reflections(*renderer, world, {.executor = executor.get(), .progress = {}, .proxy_side = 64}));
    attach_captures(world, std::move(captures));
  }
  /// Mean luminance of the floor's pixels, except those that show the highlight of a lamp itself.
  [[nodiscard]] double floor_light() {
    set("reflections.mode", "off");
    const LinearPicture highlights = shot();
    set("reflections.mode", "tiers");
    const LinearPicture seen = shot();
    double sum = 0.0;
    std::size_t count = 0;
    for (std::uint32_t y = settings.height / 2; y < settings.height; ++y)
      for (std::uint32_t x = 0; x < settings.width; ++x) {
        if (!meets_floor(ray(x, y)) || pixel(highlights, x, y).g > 0.06) continue;
        sum += glm::dot(pixel(seen, x, y), dvec3(0.2126, 0.7152, 0.0722));
        ++count;
      }
    EXPECT_GT(count, 800u);
    return sum / static_cast<double>(count);
  }
  [[nodiscard]] static bool meets_floor(const Ray& r) {
    if (!(r.direction.y < -1e-3)) return false;
    const dvec3 where = r.origin - r.direction * (r.origin.y / r.direction.y);
    return std::abs(where.x) < 11.9 && std::abs(where.z) < 5.9;
  }
  void scale_lamps(float factor) {
    for (const Entity entity : lamps) world.get<Light>(entity).intensity *= factor;
  }
  void move_lamps(double by) {
    for (const Entity entity : lamps) world.get<WorldTransform>(entity).matrix[3].x += by;
  }
};

}  // namespace gloam::test
