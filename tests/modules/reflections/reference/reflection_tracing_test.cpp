// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/reflection_tracing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/ext/vector_double2.hpp>

#include "engine/ecs/view.h"
#include "tests/modules/reflections/reference/reflection_scene.h"
#include "tests/support/worse.h"

namespace gloam {
namespace {

using test::glowing;
using test::painted;
using test::ReflectionScene;

constexpr dvec3 kDown(0.0, -1.0, 0.0);

void expect_near(const dvec3& actual, const dvec3& expected, double tolerance, std::uint32_t x, std::uint32_t y) {
  for (int c = 0; c < 3; ++c)
    ASSERT_NEAR(actual[c], expected[c], tolerance * (1e-3 + std::abs(expected[c]))) << "pixel " << x << ", " << y;
}

/// Distance of a point inside a square to its border; negative outside.
double inside(const dvec3& at, const dvec3& center, double half) {
  return half - std::max({std::abs(at.x - center.x), std::abs(at.y - center.y), std::abs(at.z - center.z)});
}

TEST(ReflectionTracing, a_mirror_floor_shows_an_emissive_square_and_the_sky_around_it) {
  ReflectionScene scene;
  scene.sky() = {.sky_zenith = {0.2f, 0.4f, 1.0f}, .sky_horizon = {0.7f, 0.6f, 0.5f}, .sky_ground = vec3(9.0f)};
  const dvec3 center(0.1, 1.2, -0.6), emitted(5.0, 3.0, 1.0);
  const Material lamp = glowing(vec3(emitted));
  scene.square(0.5, center, kDown, lamp);
  const TracedReflections traced = scene.trace();
  int square = 0, sky = 0;
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const ReflectionScene::Mirrored ray = scene.mirrored(x, y);
    const std::optional<dvec3> at = ray.at(kDown, -center.y);
    const double margin = at ? inside(*at, center, 0.5) : -1.0;
    if (std::abs(margin) < 2e-3) return;
    const dvec3 there =
        margin > 0.0 ? emitted + test::oracle_ambient(test::surface_of(lamp, *at, kDown, ray.direction), scene.sky())
                     : test::oracle_sky(scene.sky(), ray.direction);
    expect_near(radiance, there, 1e-3, x, y);
    ++(margin > 0.0 ? square : sky);
  });
  EXPECT_GT(square, 30);
  EXPECT_GT(sky, 200);
}

TEST(ReflectionTracing, the_nearest_surface_is_seen) {
  ReflectionScene scene;
  scene.square(3.0, {0.0, 3.0, 0.0}, kDown, glowing({1.0f, 0.0f, 0.0f}));
  const dvec3 center(0.0, 1.0, -0.5);
  scene.square(0.6, center, kDown, glowing({0.0f, 1.0f, 0.0f}));
  // The back of a square that is not double-sided is not seen.
  scene.square(5.0, {0.0, 0.2, 0.0}, -kDown, glowing({0.0f, 0.0f, 1.0f}));
  const TracedReflections traced = scene.trace();
  int front = 0;
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const ReflectionScene::Mirrored ray = scene.mirrored(x, y);
    const std::optional<dvec3> at = ray.at(kDown, -center.y), above = ray.at(kDown, -3.0);
    if (!at || !above || std::abs(inside(*at, center, 0.6)) < 2e-3 || inside(*above, {0.0, 3.0, 0.0}, 3.0) < 0.01)
      return;
    const bool near = inside(*at, center, 0.6) > 0.0;
    expect_near(radiance, near ? dvec3(0.0, 1.0, 0.0) : dvec3(1.0, 0.0, 0.0), 1e-5, x, y);
    front += near ? 1 : 0;
  });
  EXPECT_GT(front, 30);
}

TEST(ReflectionTracing, a_constant_surrounding_is_reflected_as_itself_by_any_lobe) {
  ReflectionScene scene;
  scene.sky() = {.sky_zenith = vec3(0.7f), .sky_horizon = vec3(0.7f), .sky_ground = vec3(0.7f)};
  for (const std::uint32_t roughness : {0u, 12u, 60u, 128u, 255u})
    for (const dvec3 eye : {dvec3(0.0, 1.5, 2.5), dvec3(0.0, 0.1, 3.0), dvec3(0.0, 2.0, 0.01)}) {
      scene.look_from(eye);
      scene.floor_material(roughness, 0, 128);
      const TracedReflections traced = scene.trace({.rays = 16});
      scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
        expect_near(radiance, dvec3(0.7), 1e-5, x, y);
      });
    }
}

/// A wall behind a floor, lit by a point light of which a small plate hides a part of the wall.
struct LitWall : ReflectionScene {
  static constexpr double kWallZ = -2.0;
  explicit LitWall(float roughness = 0.4f) {
    wall = painted({0.6f, 0.5f, 0.3f}, roughness, 0.3f);
    square(6.0, {0.0, 0.0, kWallZ}, {0.0, 0.0, 1.0}, wall);
    lamp.intensity = 30.0f;
    lamp.range_m = 20.0f;
    sky() = {.sky_zenith = vec3(0.1f), .sky_horizon = vec3(0.05f), .sky_ground = vec3(0.02f)};
  }
  /// The wall point that a mirrored ray meets, with its direction to the ray's origin.
  [[nodiscard]] std::optional<test::OracleSurface> seen(std::uint32_t x, std::uint32_t y) const {
    const Mirrored ray = mirrored(x, y);
    const std::optional<dvec3> at = ray.at({0.0, 0.0, 1.0}, kWallZ);
    if (!at || inside(dvec3(at->x, at->y, 0.0), dvec3(0.0), 6.0) < 0.01) return std::nullopt;
    return test::surface_of(wall, *at, {0.0, 0.0, 1.0}, ray.direction);
  }
  /// Light of the surroundings that a reflected surface has if its reflectivity is 0.
  [[nodiscard]] dvec3 ambient(const test::OracleSurface& s) { return test::oracle_ambient(s, sky()); }
  Material wall;
  Light lamp;
};

TEST(ReflectionTracing, a_reflected_surface_is_lit_by_the_lights_that_it_sees) {
  LitWall scene;
  const dvec3 lamp(0.4, 1.0, 1.0), plate(0.3, 1.0, -0.5);
  scene.light(scene.lamp, lamp);
  Material both = painted(vec3(0.0f));
  both.double_sided = true;
  scene.square(0.3, plate, {0.0, 0.0, 1.0}, both);
  const TracedReflections traced = scene.trace({.rays = 1});
  int lit = 0, dark = 0;
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const auto s = scene.seen(x, y);
    if (!s) return;
    const std::optional<dvec3> before = scene.mirrored(x, y).at({0.0, 0.0, 1.0}, plate.z);
    if (before && inside(*before, plate, 0.3) > -2e-3) return;  // the plate itself
    const double share = (plate.z - s->position.z) / (lamp.z - s->position.z);
    const double margin = inside(glm::mix(s->position, lamp, share), plate, 0.3);
    if (std::abs(margin) < 2e-3) return;
    const dvec3 direct = test::oracle_light(*s, scene.lights[0]);
    expect_near(radiance, scene.ambient(*s) + (margin > 0.0 ? dvec3(0.0) : direct), 2e-3, x, y);
    ++(margin > 0.0 ? dark : lit);
  });
  EXPECT_GT(lit, 100);
  EXPECT_GT(dark, 20);
}

TEST(ReflectionTracing, spots_and_directional_lights_light_reflected_surfaces) {
  LitWall scene;
  Light spot = scene.lamp;
  spot.kind = LightKind::spot;
  spot.inner_angle = 0.2f;
  spot.outer_angle = 0.5f;
  scene.light(spot, {0.3, 1.2, 1.5}, {0.1, 0.0, -1.0});
  Light sun = scene.lamp;
  sun.kind = LightKind::directional;
  sun.intensity = 2.0f;
  sun.apparent_angle = 0.0f;
  for (const bool directional : {false, true}) {
    if (directional) {
      scene.world.view<Light>().each([](Light& light) { light.intensity = 0.0f; });
      scene.lights.clear();
      scene.light(sun, {}, {0.2, -0.7, -1.0});
    }
    const TracedReflections traced = scene.trace({.rays = 1});
    scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
      if (const auto s = scene.seen(x, y))
        expect_near(radiance, scene.ambient(*s) + test::oracle_light(*s, scene.lights[0]), 2e-3, x, y);
    });
  }
}

TEST(ReflectionTracing, lights_share_shadow_rays_without_bias) {
  LitWall scene;
  // Half of the lights are behind a plate that hides them from the whole wall.
  for (int i = 0; i < 24; ++i) {
    Light light = scene.lamp;
    light.intensity = 1.0f + static_cast<float>(i % 5);
    light.color = {1.0f, i % 3 == 0 ? 0.2f : 0.7f, 0.4f};
    scene.light(light, {0.15 * i - 1.8, i % 2 == 0 ? 9.0 : 0.8, 1.0});
  }
  Material both = painted(vec3(0.0f));
  both.double_sided = true;
  scene.square(30.0, {0.0, 8.0, 0.0}, kDown, both);
  const TracedReflections traced = scene.trace({.rays = 1024});
  double worst = 0.0;
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const auto s = scene.seen(x, y);
    if (!s) return;
    dvec3 sum = scene.ambient(*s);
    for (std::size_t i = 1; i < scene.lights.size(); i += 2) sum += test::oracle_light(*s, scene.lights[i]);
    for (int c = 0; c < 3; ++c) worst = test::worse(worst, std::abs(radiance[c] - sum[c]) / sum[c]);
  });
  EXPECT_LT(worst, 0.015);
}

TEST(ReflectionTracing, an_emitter_with_width_has_a_penumbra_in_reflections) {
  LitWall scene(1.0f);  // no highlight, which has the lamp's width, too
  scene.lamp.width_m = 1.0f;
  const dvec3 lamp(1.5, 0.7, 0.5);
  scene.light(scene.lamp, lamp);
  Material both = painted(vec3(0.0f));
  both.double_sided = true;
  scene.square(20.0, {20.0, 0.0, -1.0}, {0.0, 0.0, 1.0}, both);  // the half plane x > 0
  const TracedReflections traced = scene.trace({.rays = 1024});
  int partly = 0;
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const auto s = scene.seen(x, y);
    const std::optional<dvec3> before = scene.mirrored(x, y).at({0.0, 0.0, 1.0}, -1.0);
    if (!s || (before && before->x > -1e-3)) return;
    // Share of a disc that faces the point, on the side x < 0 of the plane through the point and the edge.
    const dvec3 p = s->position, toward = glm::normalize(lamp - p);
    dvec3 normal = glm::normalize(glm::cross(dvec3(0.0, p.y, -1.0) - p, dvec3(0.0, 1.0, 0.0)));
    if (normal.x > 0.0) normal = -normal;
    const double across = std::sqrt(1.0 - std::pow(glm::dot(normal, toward), 2));
    const double k = std::clamp(-glm::dot(normal, lamp - p) / (across * 0.5), -1.0, 1.0);
    const double share = (std::acos(k) - k * std::sqrt(1.0 - k * k)) / test::kPiOracle;
    const dvec3 direct = test::oracle_light(*s, scene.lights[0]);
    for (int c = 0; c < 3; ++c)
      ASSERT_NEAR((radiance[c] - scene.ambient(*s)[c]) / direct[c], share, 0.01) << x << ", " << y;
    partly += share > 0.05 && share < 0.95 ? 1 : 0;
  });
  EXPECT_GT(partly, 10);
}

TEST(ReflectionTracing, meshes_that_cast_no_shadows_are_reflected_but_hide_no_light) {
  LitWall scene;
  scene.light(scene.lamp, {0.0, 0.8, 1.0});
  Material veil = glowing({0.0f, 7.0f, 0.0f});
  const dvec3 center(0.0, 3.5, -1.0);
  const Entity entity = scene.square(0.5, center, {0.0, 0.0, 1.0}, veil);
  Entity between = scene.square(4.0, {0.0, 0.0, 0.95}, {0.0, 0.0, -1.0}, veil);
  for (const Entity one : {entity, between}) scene.world.get<MeshInstance>(one).casts_shadows = false;
  const TracedReflections traced = scene.trace({.rays = 1});
  EXPECT_EQ(scene.tracer->triangles(), 2u) << "the wall";
  int veiled = 0;
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const auto s = scene.seen(x, y);
    const std::optional<dvec3> before = scene.mirrored(x, y).at({0.0, 0.0, 1.0}, center.z);
    if (!s || (before && std::abs(inside(*before, center, 0.5)) < 2e-3)) return;
    const bool is_veil = before && inside(*before, center, 0.5) > 0.0;
    veiled += is_veil ? 1 : 0;
    if (is_veil) {
      EXPECT_GT(radiance.g, 6.9);
    } else {
      expect_near(radiance, scene.ambient(*s) + test::oracle_light(*s, scene.lights[0]), 2e-3, x, y);
    }
  });
  EXPECT_GT(veiled, 5);
}

TEST(ReflectionTracing, a_bulb_does_not_hide_its_lamp) {
  LitWall scene(1.0f);
  scene.lamp.width_m = 0.1f;
  const dvec3 lamp(0.0, 0.8, 1.0);
  scene.light(scene.lamp, lamp);
  Material glass = glowing(vec3(1.0f));
  scene.maker.draw(scene.maker.mesh(test::box(vec3(0.08f), scene.maker.material(glass))),
                   glm::translate(dmat4(1.0), lamp));
  const TracedReflections traced = scene.trace({.rays = 1});
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    if (const auto s = scene.seen(x, y))
      expect_near(radiance, scene.ambient(*s) + test::oracle_light(*s, scene.lights[0]), 2e-3, x, y);
  });
}

TEST(ReflectionTracing, fog_lies_along_reflected_rays) {
  ReflectionScene scene;
  scene.sky() = {.sky_zenith = vec3(2.0f), .sky_horizon = vec3(2.0f), .sky_ground = vec3(2.0f)};
  const dvec3 center(0.0, 1.2, -0.6);
  const Material lamp = glowing(vec3(5.0f));
  scene.square(0.5, center, kDown, lamp);
  const TracedReflections traced =
      scene.trace({.fog = {.density = 0.3, .color = dvec3(0.1, 0.2, 0.3), .sky_distance_m = 6.0}});
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const ReflectionScene::Mirrored ray = scene.mirrored(x, y);
    const std::optional<dvec3> at = ray.at(kDown, -center.y);
    const double margin = at ? inside(*at, center, 0.5) : -1.0;
    if (std::abs(margin) < 2e-3) return;
    const double transmitted = std::exp(-0.3 * (margin > 0.0 ? glm::length(*at - ray.origin) : 6.0));
    const dvec3 there = margin > 0.0
                            ? 5.0 + test::oracle_ambient(test::surface_of(lamp, *at, kDown, ray.direction), scene.sky())
                            : dvec3(2.0);
    expect_near(radiance, transmitted * there + (1.0 - transmitted) * dvec3(0.1, 0.2, 0.3), 1e-3, x, y);
  });
}

TEST(ReflectionTracing, emissive_quads_lie_over_what_is_behind_them) {
  ReflectionScene scene;
  scene.sky() = {.sky_zenith = vec3(2.0f), .sky_horizon = vec3(2.0f), .sky_ground = vec3(2.0f)};
  // Left half opaque red, right half half-transparent green; a second, farther one is blue; both face the camera.
  const std::vector<vec4> image = {
      {1.0f, 0.0f, 0.0f, 1.0f}, {1.0f, 0.0f, 0.0f, 1.0f}, {0.0f, 0.5f, 0.0f, 0.5f}, {0.0f, 0.5f, 0.0f, 0.5f}};
  const std::vector<vec4> blue = {{0.0f, 0.0f, 0.25f, 0.25f}};
  const auto quad_at = [](double z, std::span<const vec4> rgba, std::uint32_t width) {
    return EmissiveQuad{.center = {0.0, 0.5, z},
                        .half_u = {0.8, 0.0, 0.0},
                        .half_v = {0.0, 0.6, 0.0},
                        .width = width,
                        .height = 1,
                        .rgba = rgba,
                        .radiance = 4.0f};
  };
  EmissiveQuad turned = quad_at(-0.2, blue, 1);  // seen from behind: not at all
  turned.half_u = -turned.half_u;
  const EmissiveQuad quads[] = {quad_at(-1.5, blue, 1), turned, quad_at(-1.0, image, 4)};
  const TracedReflections traced = scene.trace({.quads = quads});
  int red = 0, green = 0;
  scene.each_floor_pixel(traced, [&](std::uint32_t x, std::uint32_t y, const dvec3& radiance) {
    const ReflectionScene::Mirrored ray = scene.mirrored(x, y);
    const std::optional<dvec3> at = ray.at({0.0, 0.0, 1.0}, -1.0), behind = ray.at({0.0, 0.0, 1.0}, -1.5);
    if (ray.origin.z < -0.9 || !at || !behind) return;
    const auto is_in = [](const dvec3& p) { return std::abs(p.x) < 0.799 && std::abs(p.y - 0.5) < 0.599; };
    if (!is_in(*at) || !is_in(*behind) || std::abs(at->x) < 0.21) return;
    const bool left = at->x < 0.0;
    const dvec3 last = dvec3(0.0, 0.0, 1.0) + 0.75 * dvec3(2.0);
    expect_near(radiance, left ? dvec3(4.0, 0.0, 0.0) : dvec3(0.0, 2.0, 0.0) + 0.5 * last, 1e-4, x, y);
    ++(left ? red : green);
  });
  EXPECT_GT(red, 10);
  EXPECT_GT(green, 10);
}

TEST(ReflectionTracing, the_result_does_not_depend_on_threads) {
  LitWall scene;
  scene.lamp.width_m = 0.3f;
  for (int i = 0; i < 5; ++i) scene.light(scene.lamp, {0.6 * i - 1.0, 1.0, 1.0});
  scene.square(0.4, {0.0, 1.0, -0.5}, {0.0, 0.0, 1.0}, glowing(vec3(1.0f)));
  scene.floor_material(90, 255, 200);
  const TracedReflections expected = scene.trace({.rays = 8, .light_samples = 2});
  for (auto& executor :
       {make_pool_executor(1), make_pool_executor(2), make_pool_executor(8), make_shuffled_executor(3)}) {
    RadianceInput input = {.world = scene.world,
                           .geometry = scene.geometry,
                           .tracer = *scene.tracer,
                           .executor = *executor,
                           .settings = {.rays = 8, .light_samples = 2}};
    std::size_t rows = 0;
    input.progress = [&](std::size_t done, std::size_t total) {
      EXPECT_EQ(done, ++rows);
      EXPECT_EQ(total, expected.height);
    };
    const TracedReflections traced = trace_radiance(input);
    EXPECT_EQ(traced.radiance, expected.radiance);
    EXPECT_EQ(traced.version, expected.version);
    EXPECT_EQ(rows, expected.height);
  }
}

TEST(ReflectionTracing, pixels_without_reflectivity_are_not_traced) {
  ReflectionScene scene;
  scene.sky() = {.sky_zenith = vec3(1.0f), .sky_horizon = vec3(1.0f), .sky_ground = vec3(1.0f)};
  scene.geometry.material[25 * 20] &= 0x00FFFFFFu;
  const TracedReflections traced = scene.trace();
  for (std::size_t i = 0; i < traced.pixels(); ++i)
    EXPECT_EQ(traced.radiance[4 * i + 3], scene.geometry.is_sky(i) || i == 25 * 20 ? 0.0f : 1.0f);
}

}  // namespace
}  // namespace gloam
