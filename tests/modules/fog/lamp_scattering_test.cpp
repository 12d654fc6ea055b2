// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/fog/lamp_scattering.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "engine/scene/gltf/import.h"
#include "modules/accuracy/module.h"
#include "modules/shadows/components.h"
#include "tests/support/render_scene.h"

namespace gloam::test {
namespace {

constexpr double kPiDouble = 3.14159265358979323846;

/// Lights, walls, and a ray from `place` along −Z. All positions are relative to `place`.
struct FoggyScene {
  explicit FoggyScene(const dvec3& place_of_scene = dvec3(0.0)) : place(place_of_scene) {
    prepare_scene_world(world);
    world.register_component<Light>();
    world.register_component<ShadowCaster>();
  }
  void lamp(const dvec3& at, Light light, const dvec3& direction = dvec3(0.0, -1.0, 0.0), bool casts = true) {
    dmat4 matrix(1.0);
    matrix[2] = dvec4(-glm::normalize(direction), 0.0);
    matrix[3] = dvec4(place + at, 1.0);
    world.create(WorldTransform{matrix}, light, ShadowCaster{.enabled = casts});
  }
  /// A square in the plane z = at.z.
  void wall(const dvec3& at, float half) { maker.draw(maker.mesh(quad(half)), glm::translate(dmat4(1.0), place + at)); }
  /// A horizontal square in the plane y = at.y.
  void ceiling(const dvec3& at, float half) {
    maker.draw(maker.mesh(quad(half)), glm::rotate(glm::translate(dmat4(1.0), place + at), 0.5 * kPiDouble, {1, 0, 0}));
  }
  /// The mean over so many pixels with the same ray.
  [[nodiscard]] dvec3 along(double length, const Fog& fog, std::uint32_t samples, std::uint32_t pixels = 32) {
    if (!tracer) tracer = std::move(make_scene_tracer(world, *executor, place)).value();
    const TwinLights lights = gather_lights(world, *tracer);
    LampScattering lamps(lights, *tracer, fog, samples);
    dvec3 sum(0.0);
    for (std::uint32_t pixel = 0; pixel < pixels; ++pixel)
      sum += lamps.along({place - tracer->origin(), {0.0, 0.0, -1.0}, length}, pixel);
    return sum / static_cast<double>(pixels);
  }

  dvec3 place;
  World world;
  SceneMaker maker{world};
  std::unique_ptr<JobExecutor> executor = make_serial_executor();
  std::unique_ptr<SceneTracer> tracer;
};

/// The radiance of a white light without a wall, by the midpoint rule in a million steps between two distances on the
/// ray.
double integral(const Light& light, const dvec3& at, const dvec3& direction, const Fog& fog, double from, double to) {
  constexpr int kSteps = 1'000'000;
  const double density = static_cast<double>(fog.density);
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = from + (to - from) * (i + 0.5) / kSteps;
    double lux = static_cast<double>(light.intensity), way = static_cast<double>(fog.sky_distance_m);
    if (light.kind != LightKind::directional) {
      const dvec3 away = dvec3(0.0, 0.0, -t) - at;
      const double d = glm::length(away), range = static_cast<double>(light.range_m);
      lux *= std::max(1.0 - std::pow(d / range, 4.0), 0.0) / (d * d);
      way = std::min(way, d);
      if (light.kind == LightKind::spot) {
        const double outer = std::cos(static_cast<double>(light.outer_angle));
        const double inner = std::cos(static_cast<double>(light.inner_angle));
        const double cosine = glm::dot(away, glm::normalize(direction)) / d;
        lux *= std::pow(std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0), 2.0);
      }
      if (d > range) lux = 0.0;
    }
    sum += lux * std::exp(-density * (t + way));
  }
  // Half of the scattered light goes forward and is not this light's.
  return 0.5 * density / (4.0 * kPiDouble) * sum * (to - from) / kSteps;
}

struct LampCase {
  const char* name;
  Light light;
  dvec3 at;
  dvec3 direction = dvec3(0.0, -1.0, 0.0);
};

std::vector<LampCase> lamp_cases() {
  const auto point = [](float range) { return Light{.kind = LightKind::point, .intensity = 40.0f, .range_m = range}; };
  const auto spot = [](float inner, float outer) {
    return Light{
        .kind = LightKind::spot, .intensity = 40.0f, .range_m = 50.0f, .inner_angle = inner, .outer_angle = outer};
  };
  return {
      {"beside the ray", point(100.0f), {1.0, 0.5, -6.0}},
      {"next to the ray", point(100.0f), {0.01, 0.0, -6.0}},
      {"behind the camera", point(100.0f), {0.3, 0.2, 2.0}},
      {"beyond the surface", point(100.0f), {0.3, 0.2, -21.0}},
      {"with a range that ends on the ray", point(3.0f), {1.0, 0.5, -6.0}},
      {"a cone across the ray", spot(0.2f, 0.4f), {0.0, 3.0, -6.0}},
      {"a thin cone across the ray", spot(0.02f, 0.05f), {0.5, 3.0, -6.0}, {-0.15, -1.0, 0.2}},
      {"a cone along the ray", spot(0.3f, 0.6f), {0.2, 0.1, 1.0}, {0.0, 0.0, -1.0}},
      {"a cone toward the camera", spot(0.3f, 0.6f), {0.2, 0.1, -10.0}, {0.0, 0.0, 1.0}},
      {"a cone that misses the ray", spot(0.3f, 0.6f), {0.0, 3.0, -6.0}, {0.0, 1.0, 0.0}},
      {"half of all directions", spot(0.3f, 1.5707963f), {0.2, 0.5, -6.0}, {0.0, -0.2, -1.0}},
      {"the sun", {.kind = LightKind::directional, .intensity = 5.0f}, dvec3(0.0), {0.3, -1.0, 0.2}},
  };
}

// Hard case: fog.marched_lamps
TEST(LampScatteringTest, of_one_lamp_without_walls_is_the_integral_along_the_ray) {
  for (const LampCase& lamp : lamp_cases())
    for (const float density : {1e-7f, 0.02f, 0.5f, 20.0f}) {
      SCOPED_TRACE(std::string(lamp.name) + ", density " + std::to_string(density));
      FoggyScene scene;
      scene.lamp(lamp.at, lamp.light, lamp.direction);
      const Fog fog{.density = density};
      const double exact = integral(lamp.light, lamp.at, lamp.direction, fog, 0.0, 20.0);
      const dvec3 found = scene.along(20.0, fog, 256, 256);
      EXPECT_NEAR(found.g, exact, 3e-3 * exact);
      EXPECT_EQ(found.r, found.b);
    }
}

TEST(LampScatteringTest, nears_the_integral_with_more_samples) {
  const auto worst_of = [](std::uint32_t samples) {
    double worst = 0.0;
    const LampCase lamp = lamp_cases().front();
    FoggyScene scene;
    scene.lamp(lamp.at, lamp.light);
    const Fog fog{.density = 0.05f};
    const double exact = integral(lamp.light, lamp.at, lamp.direction, fog, 0.0, 20.0);
    for (std::uint32_t pixels = 1; pixels <= 16; ++pixels) {
      const double sum = scene.along(20.0, fog, samples, pixels).g * pixels;
      const double before = pixels > 1 ? scene.along(20.0, fog, samples, pixels - 1).g * (pixels - 1) : 0.0;
      worst = std::max(worst, std::abs(sum - before - exact) / exact);
    }
    return worst;
  };
  const double few = worst_of(16), many = worst_of(256);
  EXPECT_LT(few, 0.15);
  EXPECT_LT(many, 0.25 * few);
}

// Hard case: fog.marched_walls
TEST(LampScatteringTest, comes_from_no_point_that_a_wall_hides_from_the_lamp) {
  const Light light{.kind = LightKind::point, .intensity = 40.0f, .range_m = 100.0f};
  const Fog fog{.density = 0.05f};
  // The ray ends at the wall, and the lamp is behind it.
  FoggyScene behind;
  behind.lamp({0.5, 0.3, -8.5}, light);
  behind.wall({0.0, 0.0, -8.0}, 50.0f);
  EXPECT_EQ(behind.along(8.0, fog, 256), dvec3(0.0));
  FoggyScene open;
  open.lamp({0.5, 0.3, -8.5}, light);
  EXPECT_GT(open.along(8.0, fog, 256).g, 1e-3);
  // A ceiling of which the edge lies at z = −10, between the ray and a lamp above it at z = −6: the shadow of the edge
  // meets the ray at z = −14.
  for (const dvec3& place : {dvec3(0.0), dvec3(3e3, -2e3, 1e3)}) {
    FoggyScene half(place);
    half.lamp({0.0, 2.0, -6.0}, light);
    half.ceiling({0.0, 1.0, 40.0}, 50.0f);
    const double exact = integral(light, {0.0, 2.0, -6.0}, dvec3(0.0), fog, 14.0, 20.0);
    EXPECT_NEAR(half.along(20.0, fog, 256, 256).g, exact, 0.01 * exact);
  }
}

TEST(LampScatteringTest, of_a_wide_lamp_fades_where_an_edge_hides_a_part_of_it) {
  const Light light{.kind = LightKind::point, .intensity = 40.0f, .range_m = 100.0f, .width_m = 0.5f};
  const Fog fog{.density = 0.05f};
  FoggyScene scene;
  scene.lamp({0.0, 2.0, -6.0}, light);
  scene.ceiling({0.0, 1.0, 40.0}, 50.0f);
  // The share of the disc beyond the edge, from 40 pieces of the ray.
  double exact = 0.0;
  for (int i = 0; i < 40; ++i) {
    const double from = 10.0 + 0.25 * i, t = from + 0.125;
    const double d = std::hypot(t - 6.0, 2.0), across = (t - 14.0) / d;  // the edge passes the centre at t = 14
    const double k = std::clamp(-across * d / std::hypot(t - 10.0, 1.0) / 0.25, -1.0, 1.0);
    const double share = (std::acos(k) - k * std::sqrt(1.0 - k * k)) / kPiDouble;
    exact += share * integral(light, {0.0, 2.0, -6.0}, dvec3(0.0), fog, from, from + 0.25);
  }
  EXPECT_NEAR(scene.along(20.0, fog, 256, 256).g, exact, 0.02 * exact);
}

// Hard case: fog.marched_many_lamps
TEST(LampScatteringTest, of_many_lamps_is_the_light_of_those_that_no_wall_hides) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Fog fog{.density = 0.03f};
  FoggyScene scene;
  scene.ceiling({0.0, 4.0, -10.0}, 500.0f);
  double exact = 0.0;
  for (int i = 0; i < 60; ++i) {
    const Light light{.kind = LightKind::point,
                      .intensity = static_cast<float>(std::pow(10.0, 1.0 + unit(random))),
                      .range_m = 40.0f};
    const dvec3 at(3.0 * unit(random), 4.0 + (i % 2 == 0 ? 3.0 : -3.0) * (1.01 + 0.99 * unit(random)) * 0.5,
                   -10.0 + 10.0 * unit(random));
    scene.lamp(at, light);
    if (at.y < 4.0) exact += integral(light, at, dvec3(0.0), fog, 0.0, 20.0);
  }
  EXPECT_NEAR(scene.along(20.0, fog, 256, 256).g, exact, 0.01 * exact);
}

TEST(LampScatteringTest, of_a_light_without_shadows_goes_through_walls) {
  const Light light{.kind = LightKind::point, .intensity = 40.0f, .range_m = 100.0f};
  const Fog fog{.density = 0.05f};
  FoggyScene scene;
  scene.lamp({0.5, 0.3, -8.5}, light, {0.0, -1.0, 0.0}, false);
  scene.wall({0.0, 0.0, -8.0}, 50.0f);
  const double exact = integral(light, {0.5, 0.3, -8.5}, dvec3(0.0), fog, 0.0, 8.0);
  EXPECT_NEAR(scene.along(8.0, fog, 256).g, exact, 3e-3 * exact);
}

// Hard case: fog.marched_extremes
TEST(LampScatteringTest, is_finite_for_any_density_way_and_place_of_the_lamp) {
  const float densities[] = {0.0f, 1e-40f, 1e-6f, 1.0f, 1e3f, 1e9f, std::numeric_limits<float>::infinity()};
  for (const float width : {0.0f, 0.4f})
    for (const dvec3& at : {dvec3(0.0), dvec3(0.0, 0.0, -1.0), dvec3(0.1, 0.0, 0.0), dvec3(0.0, 0.0, -1e7)})
      for (const float density : densities)
        for (const double length : {0.0, 1e-9, 2.0, 200.0, 1e12}) {
          FoggyScene scene;
          scene.lamp(at, {.kind = LightKind::point, .intensity = 1e6f, .range_m = 1e9f, .width_m = width});
          scene.lamp(at, {.kind = LightKind::spot, .intensity = 1e6f, .range_m = 1e9f, .width_m = width});
          scene.lamp(at, {.kind = LightKind::directional, .intensity = 1e5f});
          const dvec3 found = scene.along(length, {.density = density, .sky_distance_m = 1e12f}, 16, 4);
          ASSERT_TRUE(std::isfinite(found.g) && found.g >= 0.0)
              << found.g << " at " << at.z << ", density " << density << ", way " << length << ", width " << width;
          if (density == 0.0f) {
            ASSERT_EQ(found, dvec3(0.0));
          }
        }
}

// Hard case: fog.marched_units
TEST(LampScatteringTest, is_the_same_in_any_unit_of_length) {
  const auto in_units = [](double unit) {
    FoggyScene scene;
    const auto f = static_cast<float>(unit);
    scene.lamp({0.5 * unit, 0.3 * unit, -6.0 * unit},
               {.kind = LightKind::point, .intensity = 40.0f * f * f, .range_m = 30.0f * f, .width_m = 0.2f * f});
    scene.wall({0.5 * unit, 0.8 * unit, -5.0 * unit}, 0.4f * f);
    return scene.along(20.0 * unit, {.density = 0.05f / f, .sky_distance_m = 200.0f * f}, 256, 8).g;
  };
  const double metres = in_units(1.0);
  for (const double unit : {1e-3, 0.0254, 1e3}) EXPECT_NEAR(in_units(unit), metres, 0.01 * metres) << unit;
}

}  // namespace
}  // namespace gloam::test
