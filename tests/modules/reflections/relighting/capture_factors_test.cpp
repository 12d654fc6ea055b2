// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/relighting/capture_factors.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/scene/resources.h"
#include "tests/modules/reflections/bake/bake_world.h"

namespace gloam {
namespace {

using test::moved;

constexpr std::size_t kCells = std::size_t{kProxyCells} * kProxyCells;

/// A world with walls that are proxies, and captures of them under the lights of the moment.
struct Captured : test::BakeWorld, testing::Test {
  ReflectionCaptures captures;
  CaptureFactors factors;

  /// A wall of 4 × 3 m that faces +Z.
  Entity wall(double x, const std::string& lights = {}) {
    IbrProxy proxy;
    proxy.size_m = vec2(4.0f, 3.0f);
    if (!lights.empty()) proxy.lights = text(lights);
    captures.proxy_entities.push_back(world.create(proxy, WorldTransform{moved(x, 1.5, 0.0)}));
    return captures.proxy_entities.back();
  }
  Entity lamp(const dvec3& at, const vec3& color = vec3(1.0f), const std::string& name = {}) {
    Light what;
    what.intensity = 100.0f;
    what.color = color;
    if (!name.empty()) return light(name, what, moved(at.x, at.y, at.z));
    return world.create(what, WorldTransform{moved(at.x, at.y, at.z)});
  }
  void capture() {
    captures.lights = light_states(world);
    captures.proxy_parts.clear();
    for (const Entity entity : captures.proxy_entities) {
      CapturedParts parts;
      parts.lamps_lux = illuminances(captures.lights, patches(entity));
      for (const vec3& lux : parts.lamps_lux) parts.lit += 0.1f * lux.y / static_cast<float>(kCells);
      captures.proxy_parts.push_back(parts);
    }
    ++captures.version;
  }
  [[nodiscard]] std::vector<LitPatch> patches(Entity proxy) const {
    PlacedProxy placed;
    EXPECT_EQ(place_proxy(proxy, world.get<IbrProxy>(proxy), world.get<WorldTransform>(proxy).matrix, placed),
              ProxyPlacement::placed);
    return proxy_patches(placed, 0.0f);
  }
  void update() { factors.update(world, captures); }
  [[nodiscard]] vec3 factor(std::size_t layer, std::size_t cell) const {
    const std::int32_t first = factors.proxies()[layer].first;
    return first < 0 ? vec3(1.0f) : vec3(factors.cells()[static_cast<std::size_t>(first) + cell]);
  }
  void expect_factors(std::size_t layer, const vec3& expected, float tolerance = 1e-5f) const {
    for (std::size_t cell = 0; cell < kCells; ++cell)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(factor(layer, cell)[c], expected[c], tolerance) << cell << ", " << c;
  }
};

/// Mean illuminance of a patch, by its definition.
double summed_illuminance(const CapturedLightState& light, const LitPatch& patch) {
  constexpr int kSteps = 400;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const dvec3 point = patch.center + ((2.0 * i + 1.0) / kSteps - 1.0) * patch.half_u +
                          ((2.0 * j + 1.0) / kSteps - 1.0) * patch.half_v;
      const dvec3 to_light = light.position - point;
      const double d = glm::length(to_light), cosine = glm::dot(patch.normal, to_light) / d;
      double share = 1.0;
      if (light.range_m > 0.0f) share = std::max(0.0, 1.0 - std::pow(d / double(light.range_m), 4.0));
      if (light.kind == LightKind::spot) {
        const double inner = std::cos(double(light.cone.x)), outer = std::cos(double(light.cone.y));
        share *=
            std::pow(std::clamp((glm::dot(-to_light / d, light.direction) - outer) / (inner - outer), 0.0, 1.0), 2);
      }
      sum += std::max(cosine, 0.0) * share / (d * d);
    }
  return sum / (kSteps * kSteps);
}

TEST(UnitIlluminance, is_the_mean_over_the_patch) {
  const LitPatch patch{.center = dvec3(1.0, 2.0, 3.0), .half_u = dvec3(1.0, 0.2, 0.0), .half_v = dvec3(0.0, 0.8, 0.0)};
  for (const dvec3& at : {dvec3(1.0, 2.0, 3.3), dvec3(2.5, 3.0, 3.7), dvec3(-4.0, 5.0, 9.0), dvec3(40.0, 9.0, 30.0)}) {
    CapturedLightState light{.emitted = vec3(1.0f), .position = at};
    const double point = summed_illuminance(light, patch);
    EXPECT_NEAR(unit_illuminance(light, patch), point, 0.01 * point) << at.x;
    light.range_m = 60.0f;
    light.kind = LightKind::spot;
    light.direction = glm::normalize(patch.center + dvec3(0.3, 0.0, 0.0) - at);
    light.cone = vec2(0.3f, 1.2f);
    const double spot = summed_illuminance(light, patch);
    EXPECT_NEAR(unit_illuminance(light, patch), spot, 0.12 * spot) << at.x;
    light.position.z = 6.0 - at.z;
    EXPECT_EQ(unit_illuminance(light, patch), 0.0) << "from behind";
  }
  const CapturedLightState sun{
      .emitted = vec3(1.0f), .kind = LightKind::directional, .direction = dvec3(0.6, 0.0, -0.8)};
  EXPECT_NEAR(unit_illuminance(sun, patch), 0.8, 1e-12);
  EXPECT_EQ(unit_illuminance(sun, LitPatch{}), 0.0) << "a patch without size";
}

// Hard case: reflections.lights_1024
TEST_F(Captured, lights_as_captured_have_no_factors_and_compute_nothing) {
  for (int i = 0; i < 50; ++i) wall(5.0 * i);
  for (int i = 0; i < 1024; ++i) lamp({0.25 * i, 2.0, 2.0});
  capture();
  update();
  EXPECT_EQ(factors.evaluations(), 0u);
  EXPECT_TRUE(factors.cells().empty());
  const auto begin = std::chrono::steady_clock::now();
  for (int frame = 0; frame < 100; ++frame) update();
  const double us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count() / 100;
  RecordProperty("update_of_1024_unchanged_lights_us", std::to_string(us));
  EXPECT_EQ(factors.evaluations(), 0u);
  EXPECT_EQ(factors.version(), 1u);
  world.get<Light>(captures.lights[7].light).intensity *= 0.5f;
  update();
  EXPECT_EQ(factors.evaluations(), 50 * kCells) << "of the light that has changed";
  update();
  world.get<Light>(captures.lights[7].light).intensity *= 0.5f;
  update();
  EXPECT_EQ(factors.evaluations(), 50 * kCells) << "kept";
  const auto fade = [&] {
    for (const CapturedLightState& light : captures.lights) world.get<Light>(light.light).intensity *= 0.9f;
    const auto start = std::chrono::steady_clock::now();
    update();
    return std::to_string(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  };
  RecordProperty("first_fade_of_1024_lights_ms", fade());
  RecordProperty("next_fade_of_1024_lights_ms", fade());
}

TEST_F(Captured, one_factor_for_all_lights_is_that_of_the_capture) {
  wall(0.0);
  for (const double x : {-1.0, 1.5, 4.0}) lamp({x, 2.0, 1.0}, {1.0f, 0.7f, 0.3f});
  capture();
  for (const vec3& scale : {vec3(0.5f), vec3(2.0f), vec3(0.25f, 1.0f, 3.0f), vec3(0.0f)}) {
    for (const CapturedLightState& light : captures.lights)
      world.get<Light>(light.light).color = vec3(1.0f, 0.7f, 0.3f) * scale;
    update();
    expect_factors(0, scale);
    EXPECT_LT(factors.proxies()[0].error, 1e-6f) << scale.x << " " << scale.y;
  }
}

// Hard case: reflections.light_added_again
TEST_F(Captured, a_light_that_is_destroyed_and_added_again_leaves_all_as_it_was) {
  wall(0.0);
  lamp({1.0, 2.0, 2.0});
  const Entity first = lamp({-1.0, 2.0, 1.0});
  capture();
  world.destroy(first);
  update();
  EXPECT_LT(factor(0, 0).x, 0.5f);
  EXPECT_GT(factors.proxies()[0].error, 0.1f);
  lamp({-1.0, 2.0, 1.0});
  update();
  expect_factors(0, vec3(1.0f), 1e-6f);
  EXPECT_LT(factors.cells().size(), kCells + 1);
}

TEST_F(Captured, lights_that_move_or_come_are_as_new_ones_and_make_the_capture_outdated) {
  wall(0.0);
  const Entity mover = lamp({-1.0, 2.0, 1.0});
  capture();
  world.get<WorldTransform>(mover).matrix[3].x = 12.0;
  lamp({1.0, 1.0, 1.0}, {0.0f, 1.0f, 0.0f});
  const std::vector<vec3> now = illuminances(light_states(world), patches(captures.proxy_entities[0]));
  update();
  EXPECT_EQ(factors.outdated(), 1u);
  dvec3 shown(0.0), expected(0.0);
  for (std::size_t cell = 0; cell < kCells; ++cell) {
    shown += dvec3(factor(0, cell) * captures.proxy_parts[0].lamps_lux[cell]);
    expected += dvec3(now[cell]);
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], expected[c], 0.1 * expected[c]) << c;
}

TEST_F(Captured, a_small_move_does_not_make_the_capture_outdated) {
  wall(0.0);
  const Entity mover = lamp({-1.0, 2.0, 2.0});
  capture();
  world.get<WorldTransform>(mover).matrix[3].x += 0.05;
  update();
  EXPECT_EQ(factors.outdated(), 0u);
}

// Hard case: reflections.light_not_finite
TEST_F(Captured, numbers_that_are_not_finite_are_lights_that_are_off) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  wall(0.0);
  const Entity good = lamp({1.0, 2.0, 2.0}), bad = lamp({-1.0, 2.0, 2.0});
  world.get<Light>(bad).intensity = nan;
  capture();
  EXPECT_EQ(captures.lights[1].emitted, vec3(0.0f));
  update();
  EXPECT_TRUE(factors.cells().empty());
  world.get<Light>(bad).intensity = infinite;
  update();
  EXPECT_EQ(factors.version(), 1u) << "not usable either";
  for (const float value : {nan, infinite, -infinite, -5.0f}) {
    world.get<Light>(good).intensity = value;
    update();
    expect_factors(0, vec3(0.0f));
  }
  world.get<Light>(good).intensity = 100.0f;
  for (int axis = 0; axis < 3; ++axis) {
    world.get<WorldTransform>(good).matrix[3][axis] = std::numeric_limits<double>::quiet_NaN();
    update();
    const std::uint64_t version = factors.version();
    update();
    EXPECT_EQ(factors.version(), version) << "a NaN differs from itself";
    expect_factors(0, vec3(0.0f));
  }
  world.get<Light>(bad).intensity = 3e38f;
  world.get<Light>(bad).color = vec3(0.5f);
  update();
  for (const vec4& cell : factors.cells())
    for (int c = 0; c < 4; ++c) EXPECT_TRUE(std::isfinite(cell[c]) && cell[c] >= 0.0f && cell[c] <= kMostCaptureFactor);
}

// Hard case: reflections.dark_at_capture
TEST_F(Captured, what_was_dark_is_outdated_when_it_is_lit) {
  wall(0.0);
  const Entity lamp_then = lamp({1.0, 2.0, 2.0});
  world.get<Light>(lamp_then).intensity = 0.0f;
  capture();
  update();
  EXPECT_EQ(factors.outdated(), 0u);
  world.get<Light>(lamp_then).intensity = 50.0f;
  update();
  expect_factors(0, vec3(1.0f));
  EXPECT_EQ(factors.outdated(), 1u);
  EXPECT_EQ(factors.proxies()[0].error, 1.0f);
  captures.proxy_parts[0].unlit = 1e4f;
  ++captures.version;
  update();
  EXPECT_EQ(factors.outdated(), 0u) << "beside much light of its own, it is not seen";
}

// Hard case: reflections.no_lights
TEST_F(Captured, without_lights_and_behind_lights_there_is_no_factor) {
  wall(0.0);
  const Entity behind = lamp({0.0, 1.0, -3.0});
  capture();
  world.get<Light>(behind).intensity = 5.0f;
  update();
  expect_factors(0, vec3(1.0f));
  world.destroy(behind);
  update();
  expect_factors(0, vec3(1.0f));
  EXPECT_EQ(factors.outdated(), 0u);
}

// Hard case: reflections.light_turned
TEST_F(Captured, a_directional_light_that_turns_scales_by_the_cosine) {
  wall(0.0);
  Light sun;
  sun.kind = LightKind::directional;
  sun.intensity = 10.0f;
  const auto turned = [](double degrees) {
    return glm::rotate(dmat4(1.0), degrees * 0.017453292519943295, dvec3(0.0, 1.0, 0.0));
  };
  const Entity entity = world.create(sun, WorldTransform{turned(0.0)});
  capture();
  for (const double degrees : {30.0, -60.0, 89.0, 120.0}) {
    world.get<WorldTransform>(entity).matrix = turned(degrees);
    update();
    expect_factors(0, vec3(static_cast<float>(std::max(std::cos(degrees * 0.017453292519943295), 0.0))), 1e-4f);
  }
}

TEST_F(Captured, named_lights_alone_count) {
  lamp({1.0, 2.0, 2.0}, vec3(1.0f), "own");
  const Entity other = lamp({-1.0, 2.0, 1.0}, vec3(1.0f), "other");
  const Entity proxy = wall(0.0, "own");
  capture();
  captures.proxy_lights = {{0, captures.lights[0].light, 1.0f}};
  captures.proxy_parts[0].lamps_lux = illuminances(std::span(captures.lights).first(1), patches(proxy));
  world.get<Light>(other).intensity = 0.0f;
  lamp({0.0, 2.0, 1.0});
  update();
  expect_factors(0, vec3(1.0f));
  world.get<Light>(captures.lights[0].light).intensity *= 0.5f;
  update();
  expect_factors(0, vec3(0.5f));
}

TEST_F(Captured, captures_without_parts_and_of_entities_that_are_gone_have_no_factors) {
  const Entity proxy = wall(0.0);
  const Entity light_then = lamp({1.0, 2.0, 2.0});
  captures.lights = light_states(world);
  world.get<Light>(light_then).intensity = 1.0f;
  update();
  expect_factors(0, vec3(1.0f));
  capture();
  world.destroy(proxy);
  world.get<Light>(light_then).intensity = 5.0f;
  update();
  EXPECT_EQ(factors.proxies()[0].first, -1);
}

}  // namespace
}  // namespace gloam
