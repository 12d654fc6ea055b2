// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/indirect_tracing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/modules/reflections/reference/reflection_scene.h"

namespace gloam {
namespace {

using test::glowing;
using test::ReflectionScene;

struct IndirectScene : ReflectionScene {
  [[nodiscard]] TracedIndirect trace_diffuse(std::uint32_t rays) {
    tracer = std::move(make_scene_tracer(world, *executor, view.position)).value();
    return trace_indirect(input({.rays = rays}));
  }
  template <class Check>
  void each(const TracedIndirect& traced, const Check& check) const {
    int checked = 0;
    for (std::uint32_t y = 0; y < traced.height; ++y)
      for (std::uint32_t x = 0; x < traced.width; ++x) {
        const std::size_t pixel = std::size_t{y} * traced.width + x;
        if (geometry.is_sky(pixel)) continue;
        const float* const texel = &traced.radiance[4 * pixel];
        check(geometry.position(x, y) + view.position, dvec3(texel[0], texel[1], texel[2]));
        ++checked;
      }
    EXPECT_GT(checked, 100);
  }
};

TEST(IndirectTracing, an_open_floor_sees_the_sky_weighted_by_the_cosine) {
  IndirectScene scene;
  scene.sky() = {.sky_zenith = {0.2f, 0.4f, 1.0f}, .sky_horizon = {0.7f, 0.6f, 0.5f}, .sky_ground = vec3(9.0f)};
  // ∫ 2 y mix(horizon, zenith, √y) dy = horizon + (zenith − horizon) · 4 / 5.
  const dvec3 expected = 0.2 * dvec3(scene.sky().sky_horizon) + 0.8 * dvec3(scene.sky().sky_zenith);
  scene.each(scene.trace_diffuse(1024), [&](const dvec3&, const dvec3& found) {
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], expected[c], 0.01 * expected[c]);
  });
}

TEST(IndirectTracing, a_glowing_wall_gives_its_form_factor) {
  IndirectScene scene;
  scene.sky() = {.sky_zenith = vec3(0.0f), .sky_horizon = vec3(0.0f), .sky_ground = vec3(0.0f)};
  scene.square(200.0, {0.0, 200.0, -6.0}, {0.0, 0.0, 1.0}, glowing({3.0f, 0.0f, 0.0f}));
  // A quarter of the sphere, a half of the hemisphere: of a plane at right angles half of the light, cut off at 400 m.
  scene.each(scene.trace_diffuse(1024), [&](const dvec3& at, const dvec3& found) {
    const double distance = at.z + 6.0;
    if (distance < 0.1) return;  // behind it
    const double factor = 0.5 * (1.0 - distance / std::hypot(distance, 400.0));
    ASSERT_NEAR(found.x, 3.0 * factor, 0.03);
    ASSERT_EQ(found.y, 0.0);
  });
}

TEST(IndirectTracing, a_lit_ceiling_gives_what_it_reflects_and_nothing_of_the_sky_that_lights_it) {
  IndirectScene scene;
  scene.sky() = {.sky_zenith = vec3(5.0f), .sky_horizon = vec3(5.0f), .sky_ground = vec3(5.0f)};
  Material matt = test::painted({0.5f, 0.25f, 0.0f}, 1.0f, 0.0f);
  scene.square(500.0, {0.0, 2.0, 0.0}, {0.0, -1.0, 0.0}, matt);
  const dvec3 dark_before = dvec3(0.0);
  scene.each(scene.trace_diffuse(64), [&](const dvec3&, const dvec3& found) {
    ASSERT_LT(glm::length(found - dark_before), 0.05) << "an unlit ceiling hides the sky up to its border";
  });
  Light sun;
  sun.kind = LightKind::directional;
  sun.intensity = 10.0f;
  scene.light(sun, dvec3(0.0), dvec3(0.0, 1.0, 0.0));
  scene.each(scene.trace_diffuse(256), [&](const dvec3&, const dvec3& found) {
    ASSERT_NEAR(found.x / found.y, 2.0, 0.35) << "the colour of the paint, and its highlight";
    ASSERT_NEAR(found.x, 10.0 * 0.5 / std::numbers::pi, 0.12 * 10.0 * 0.5 / std::numbers::pi);
  });
}

TEST(IndirectTracing, does_not_depend_on_the_executor) {
  IndirectScene scene;
  scene.square(1.0, {0.0, 1.0, -1.0}, {0.0, 0.0, 1.0}, glowing(vec3(1.0f)));
  const TracedIndirect serial = scene.trace_diffuse(16);
  scene.executor = make_pool_executor(3);
  EXPECT_EQ(scene.trace_diffuse(16).radiance, serial.radiance);
}

}  // namespace
}  // namespace gloam
