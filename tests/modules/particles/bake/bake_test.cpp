// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "engine/math/packing.h"
#include "engine/scene/posing/animation.h"
#include "engine/schedule/schedule.h"
#include "modules/particles/bake/grid.h"
#include "modules/particles/bake/texels.h"
#include "modules/particles/emitters/placed.h"
#include "modules/particles/emitters/strongest_lights.h"
#include "tests/modules/particles/bake/bake_scene.h"

namespace gloam {
namespace {

using test::BakeScene;
using test::WallTracer;

const WallTracer kEmpty(0.0);  // a wall without area

dvec3 direction_part(const BakedFlux& flux) {
  return {half_to_float(flux[0]), half_to_float(flux[1]), half_to_float(flux[2])};
}
double fluence(const BakedFlux& flux) { return static_cast<double>(half_to_float(flux[3])); }

struct Expected {
  dvec3 along = dvec3(0.0);
  double fluence = 0.0;
  double seen = 0.0;  ///< share of the rays that reach the lamp
};

/// Mean over many random points of a texel's cell and of a lamp's disc, which faces the point.
Expected brute_force(const ParticleLightMap& map, std::size_t texel, const dvec3& lamp, double candela, double range_m,
                     double radius_m, const WallTracer& wall) {
  std::mt19937 random(static_cast<std::uint32_t>(texel));
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr int kRays = 4000;
  Expected mean;
  for (int i = 0; i < kRays; ++i) {
    const dvec3 extent = (dvec3(map.box.max) - dvec3(map.box.min)) / dvec3(map.size);
    const dvec3 cell(static_cast<double>(texel % map.size.x), static_cast<double>(texel / map.size.x % map.size.y),
                     static_cast<double>(texel / (map.size.x * map.size.y)));
    const dvec3 from =
        map.origin + dvec3(map.box.min) + extent * (cell + dvec3(unit(random), unit(random), unit(random)));
    const dvec3 to = glm::normalize(lamp - from);
    const dvec3 u = glm::normalize(glm::cross(to, std::abs(to.y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0)));
    const double r = radius_m * std::sqrt(unit(random)), a = 6.283185307179586 * unit(random);
    const dvec3 target = lamp + r * (std::cos(a) * u + std::sin(a) * glm::cross(to, u));
    if (wall.crosses(from, target)) continue;
    const double d2 = glm::dot(lamp - from, lamp - from), ratio = d2 / (range_m * range_m);
    const double lux = candela / d2 * (1.0 - ratio * ratio) * (1.0 - ratio * ratio);
    mean.along += lux / kRays * to;
    mean.fluence += lux / kRays;
    mean.seen += 1.0 / kRays;
  }
  return mean;
}

TEST(BakedParticleLight, is_the_mean_of_the_lamps_light_in_each_cell) {
  BakeScene scene;
  scene.add_emitter({2.0, 0.0, 0.0});
  scene.add_lamp({0.0, 0.5, 0.3});
  const ParticleLightMaps maps = scene.bake(kEmpty);
  ASSERT_EQ(maps.maps.size(), 1u);
  const ParticleLightMap& map = maps.maps[0];
  for (std::size_t texel = 0; texel < map.texels(); texel += 3) {
    const Expected expected = brute_force(map, texel, {0.0, 0.5, 0.3}, 100.0, 50.0, 0.0, kEmpty);
    const double tolerance = 0.03 * expected.fluence;
    for (const auto& channel : map.flux) {
      ASSERT_NEAR(fluence(channel[texel]), expected.fluence, tolerance) << texel;
      ASSERT_LT(glm::length(direction_part(channel[texel]) - expected.along), tolerance) << texel;
    }
  }
}

TEST(BakedParticleLight, is_dark_behind_a_wall_and_half_dark_in_its_penumbra) {
  const WallTracer wall(1.0);
  BakeScene scene;
  scene.add_emitter({1.5, 1.0, 0.0}, {0.5f, 3.0f, 0.5f});
  const Entity lamp = scene.add_lamp({-1.5, 0.0, 0.0}, 100.0f, 0.4f);
  const ParticleLightMap map = scene.bake(wall).maps.at(0);
  ASSERT_EQ(map.static_lights, std::vector<Entity>{lamp});
  double error = 0.0;
  int dark = 0, half = 0, lit = 0;
  for (std::size_t texel = 0; texel < map.texels(); ++texel) {
    const Expected expected = brute_force(map, texel, {-1.5, 0.0, 0.0}, 100.0, 50.0, 0.2, wall);
    const Expected open = brute_force(map, texel, {-1.5, 0.0, 0.0}, 100.0, 50.0, 0.2, kEmpty);
    const double share = fluence(map.flux[0][texel]) / open.fluence;
    if (expected.seen == 0.0) {
      ASSERT_EQ(share, 0.0);
    }
    (expected.seen == 0.0 ? dark : expected.seen < 0.999 ? half : lit) += 1;
    error += std::abs(share - expected.fluence / open.fluence);
  }
  EXPECT_GT(std::min({dark, half, lit}), 20);
  EXPECT_LT(error / static_cast<double>(map.texels()), 0.02);
}

TEST(BakedParticleLight, of_sky_and_ground_is_what_surfaces_without_a_map_get) {
  const SceneEnvironment sky{
      .sky_zenith = {0.1f, 0.2f, 0.9f}, .sky_horizon = {0.5f, 0.4f, 0.3f}, .sky_ground = {0.05f, 0.1f, 0.02f}};
  const Flux flux = ambient_flux(sky);
  for (const double up : {-1.0, -0.3, 0.0, 0.8, 1.0}) {
    for (int c = 0; c < 3; ++c) {
      const double above = 0.5 * static_cast<double>(sky.sky_zenith[c] + sky.sky_horizon[c]);
      const double ground = static_cast<double>(sky.sky_ground[c]);
      const double mean = ground + (above - ground) * (0.5 + 0.5 * up);  // of the hemisphere around the normal
      const double baked = (flux.fluence[c] + up * flux.along[c].y) / (4.0 * 3.14159265358979);
      EXPECT_NEAR(baked, mean, 1e-6);
    }
  }
}

TEST(BakedParticleLight, is_finite_around_a_lamp_inside_the_cloud) {
  BakeScene scene;
  scene.add_emitter({0.0, 0.0, 0.0});
  scene.add_lamp({0.0, 0.0, 0.0}, 1e6f);
  const ParticleLightMap map = scene.bake(kEmpty).maps.at(0);
  for (const BakedFlux& texel : map.flux[0]) {
    ASSERT_LE(fluence(texel), 65504.0);
    ASSERT_GT(fluence(texel), 0.0);
    ASSERT_LE(glm::length(direction_part(texel)), 1.001 * fluence(texel));
  }
}

TEST(BakedParticleLight, of_bright_lamps_is_that_of_a_faint_one_times_its_scale) {
  const auto baked = [](float candela) {
    BakeScene scene;
    scene.add_emitter({2.0, 0.0, 0.0});
    scene.add_lamp({0.0, 0.5, 0.3}, candela);
    return scene.bake(WallTracer(1.0)).maps.at(0);
  };
  const ParticleLightMap faint = baked(100.0f);
  EXPECT_EQ(faint.light_scale, 1.0f);
  for (const int k : {4, 12, 20, 40}) {
    SCOPED_TRACE(k);
    const double factor = std::exp2(k);
    const ParticleLightMap bright = baked(100.0f * static_cast<float>(factor));
    int exponent = 0;
    EXPECT_EQ(std::frexp(bright.light_scale, &exponent), 0.5f);
    EXPECT_EQ(bright.light_scale == 1.0f, k == 4);
    for (std::size_t texel = 0; texel < faint.texels(); ++texel)
      for (std::size_t i = 0; i < 4; ++i) {
        const double wanted = static_cast<double>(half_to_float(faint.flux[0][texel][i])) * factor;
        const double found =
            static_cast<double>(half_to_float(bright.flux[0][texel][i])) / static_cast<double>(bright.light_scale);
        ASSERT_NEAR(found, wanted, 1e-3 * std::abs(wanted) + 6e-8 * factor) << texel;
      }
  }
}

TEST(BakedParticleLight, of_many_lamps_needs_few_rays) {
  BakeScene scene;
  scene.add_emitter({0.0, 0.0, 0.0});
  for (int i = 0; i < 1024; ++i) scene.add_lamp({5.0 + i % 32, 1.0, 5.0 + i / 32}, 10.0f, 0.1f);
  const WallTracer wall(1.0);
  const ParticleLightMap map = scene.bake(wall).maps.at(0);
  EXPECT_LE(wall.traced, map.texels() * (1024 + ParticleBakeOptions{}.rays_per_texel));
  EXPECT_GE(wall.traced, map.texels() * 1000);
}

TEST(BakedParticleLight, does_not_depend_on_threads) {
  const WallTracer wall(1.0);
  BakeScene scene;
  scene.add_emitter({1.5, 1.0, 0.0});
  scene.add_emitter({3.0, 0.0, 1.0});
  scene.add_lamp({-1.5, 0.0, 0.0}, 100.0f, 0.4f);
  scene.add_lamp({-1.0, 2.0, 0.0}, 30.0f, 0.1f);
  const std::string expected = encode_particle_light(scene.world, scene.bake(wall));
  EXPECT_EQ(encode_particle_light(scene.world, scene.bake(wall, *make_shuffled_executor(7))), expected);
  EXPECT_EQ(encode_particle_light(scene.world, scene.bake(wall, *make_pool_executor(3))), expected);
}

TEST(BakedParticleLight, leaves_moving_lamps_to_frames_and_moving_emitters_without_a_map) {
  BakeScene scene;
  const Entity moving = scene.add_emitter({2.0, 0.0, 0.0});
  const Entity resting = scene.add_emitter({4.0, 0.0, 0.0});
  const Entity lamp = scene.add_lamp({0.0, 0.0, 0.0});
  const Entity swinging = scene.add_lamp({0.0, 1.0, 0.0});
  scene.world.resource<AnimationBindings>().poses = {{moving, 0, 0}, {swinging, 0, 0}};
  const ParticleLightMaps maps = scene.bake(kEmpty);
  ASSERT_EQ(maps.maps.size(), 1u);
  EXPECT_EQ(maps.maps[0].emitter, resting);
  EXPECT_EQ(maps.maps[0].static_lights, std::vector<Entity>{lamp});
  EXPECT_TRUE(maps.maps[0].lights.empty());
}

TEST(BakedParticleLight, of_lamps_with_cookies_is_their_visibility) {
  const WallTracer wall(1.0);
  BakeScene scene;
  scene.add_emitter({1.5, 1.0, 0.0}, {0.5f, 3.0f, 0.5f});
  std::vector<Entity> lamps;
  for (int i = 0; i < 6; ++i) {
    lamps.push_back(scene.add_lamp({-1.5, 0.0, 0.0}, 10.0f + static_cast<float>(i)));
    scene.world.get<Light>(lamps.back()).cookie = 1;
  }
  const ParticleLightMap map = scene.bake(wall).maps.at(0);
  EXPECT_TRUE(map.static_lights.empty());
  EXPECT_EQ(map.lights, (std::vector<Entity>{lamps[5], lamps[4], lamps[3], lamps[2]}));
  ASSERT_EQ(map.visibility.size(), map.texels());
  double error = 0.0;
  for (std::size_t texel = 0; texel < map.texels(); ++texel) {
    EXPECT_EQ(fluence(map.flux[0][texel]), 0.0);
    const Expected expected = brute_force(map, texel, {-1.5, 0.0, 0.0}, 10.0, 50.0, 0.0, wall);
    for (const std::uint8_t seen : map.visibility[texel]) error += std::abs(seen / 255.0 - expected.seen);
  }
  EXPECT_LT(error / static_cast<double>(4 * map.texels()), 0.03);
}

TEST(BakedParticleLight, far_from_the_origin_is_the_same) {
  const dvec3 far(1e5, 0.0, -1e5);
  BakeScene near_scene, far_scene;
  near_scene.add_emitter({2.0, 0.0, 0.0});
  near_scene.add_lamp({0.0, 0.5, 0.3});
  far_scene.add_emitter(far + dvec3(2.0, 0.0, 0.0));
  far_scene.add_lamp(far + dvec3(0.0, 0.5, 0.3));
  const ParticleLightMap a = near_scene.bake(kEmpty).maps.at(0);
  const ParticleLightMap b = far_scene.bake(WallTracer(0.0, far)).maps.at(0);
  ASSERT_EQ(a.size, b.size);
  for (std::size_t texel = 0; texel < a.texels(); ++texel)
    ASSERT_NEAR(fluence(a.flux[0][texel]), fluence(b.flux[0][texel]), 2e-3 * fluence(a.flux[0][texel]));
}

// Hard case: particles.emitter_no_size
TEST(BakedParticleLight, of_an_emitter_of_no_size_has_a_grid) {
  BakeScene scene;
  const Entity emitter = scene.add_emitter({0.0, 0.0, 0.0}, vec3(0.0f));
  scene.world.get<ParticleEmitter>(emitter).size_m = 0.0f;
  scene.world.get<ParticleEmitter>(emitter).speed = 0.0f;
  const ParticleLightMap map = scene.bake(kEmpty).maps.at(0);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GE(map.size[i], 2u);
    EXPECT_LT(map.box.min[i], map.box.max[i]);
  }
}

TEST(ParticleLightMaps, are_not_used_once_a_light_or_the_emitter_has_changed) {
  BakeScene scene;
  const Entity emitter = scene.add_emitter({2.0, 0.0, 0.0});
  const Entity lamp = scene.add_lamp({0.0, 0.0, 0.0});
  scene.world.set_resource(EmitterSet{});
  scene.world.set_resource(EmitterPaths{});
  scene.world.set_resource(EmitterLights{});
  scene.world.set_resource(scene.bake(kEmpty));
  Schedule schedule;
  schedule.add_system("particle_emitters", "particles", Stage::world, &particle_emitters_system);
  schedule.add_system("particle_lights", "particles", Stage::world, &particle_lights_system);
  const auto lights = [&]() -> const LightsOfEmitter& {
    schedule.run(Stage::world, scene.world, *make_serial_executor());
    return scene.world.resource<EmitterLights>().emitters.at(0);
  };
  EXPECT_EQ(lights().map, 0u);
  EXPECT_EQ(lights().count, 0u) << "the lamp's light is in the map";
  const auto outdated = [&] {
    const LightsOfEmitter& found = lights();
    EXPECT_EQ(scene.world.resource<EmitterLights>().outdated, 1u);
    return found.map == ~0u;
  };
  scene.world.get<Light>(lamp).intensity = 1.0f;
  EXPECT_TRUE(outdated());
  EXPECT_EQ(lights().count, 1u) << "without its map, the emitter is lit by the lamp itself";
  scene.world.get<Light>(lamp).intensity = 100.0f;
  EXPECT_EQ(lights().map, 0u);
  scene.world.get<WorldTransform>(lamp).matrix[3].y = 0.5;
  EXPECT_TRUE(outdated());
  scene.world.get<WorldTransform>(lamp).matrix[3].y = 0.0;
  scene.world.get<WorldTransform>(emitter).matrix[3].y = 0.5;
  EXPECT_TRUE(outdated());
  scene.world.get<WorldTransform>(emitter).matrix[3].y = 0.0;
  EXPECT_EQ(lights().map, 0u);
  static_cast<void>(scene.add_lamp({3.0, 0.0, 0.0}));
  EXPECT_EQ(lights().map, 0u);
  EXPECT_EQ(lights().count, 1u) << "a new lamp lights beside the map";
  scene.world.destroy(lamp);
  EXPECT_TRUE(outdated());
}

TEST(ParticleLightMaps, without_room_in_the_atlas_are_not_used) {
  BakeScene scene;
  constexpr std::uint32_t kFitting = kMostMapSlices / kMostMapSide;
  const Entity lamp = scene.add_lamp({0.0, 2.0, 0.0});
  ParticleLightMaps maps;
  for (std::uint32_t i = 0; i <= kFitting; ++i) {
    ParticleLightMap map;
    map.emitter = scene.add_emitter({0.0, 0.0, 0.0});
    map.box = {vec3(-1.0f), vec3(1.0f)};
    map.size = uvec3(1, 1, kMostMapSide);
    for (auto& channel : map.flux) channel.resize(map.texels());
    map.static_lights = {lamp};
    maps.maps.push_back(map);
  }
  mark_as_current(scene.world, maps);
  scene.world.set_resource(maps);
  scene.world.set_resource(EmitterSet{});
  scene.world.set_resource(EmitterPaths{});
  scene.world.set_resource(EmitterLights{});
  Schedule schedule;
  schedule.add_system("particle_emitters", "particles", Stage::world, &particle_emitters_system);
  schedule.add_system("particle_lights", "particles", Stage::world, &particle_lights_system);
  schedule.run(Stage::world, scene.world, *make_serial_executor());
  const EmitterLights& lights = scene.world.resource<EmitterLights>();
  ASSERT_EQ(lights.emitters.size(), kFitting + 1);
  EXPECT_EQ(lights.emitters[kFitting - 1].map, kFitting - 1);
  EXPECT_EQ(lights.emitters[kFitting - 1].count, 0u);
  EXPECT_EQ(lights.emitters[kFitting].map, ~0u);
  EXPECT_EQ(lights.emitters[kFitting].count, 1u) << "the lamp lights it instead";
}

TEST(BakedParticleLight, of_this_moment_has_moving_lamps_and_the_exact_light_of_four) {
  const WallTracer wall(1.0);
  BakeScene scene;
  const Entity moving = scene.add_emitter({1.5, 1.0, 0.0});
  const Entity other = scene.add_emitter({1.5, 1.0, 0.0});
  std::vector<Entity> lamps;
  for (int i = 0; i < 6; ++i) lamps.push_back(scene.add_lamp({-1.5, 0.0, 0.0}, 10.0f + static_cast<float>(i)));
  scene.world.get<Light>(lamps[1]).cookie = 1;
  scene.world.resource<AnimationBindings>().poses = {{moving, 0, 0}, {lamps[5], 0, 0}, {lamps[0], 0, 0}};
  const ParticleBakeOptions options = {.moment = BakedMoment::now, .emitters = {moving}, .texel_m = 0.5};
  const auto executor = make_serial_executor();
  const ParticleLightMaps maps =
      bake_particle_light({.world = scene.world, .tracer = wall, .executor = *executor, .options = options});
  ASSERT_EQ(maps.maps.size(), 1u);
  const ParticleLightMap& map = maps.maps[0];
  EXPECT_EQ(map.emitter, moving);
  EXPECT_LT(map.texels(), scene.bake(wall).maps.at(0).texels());
  EXPECT_EQ(map.lights, (std::vector<Entity>{lamps[1], lamps[5], lamps[4], lamps[3]}));
  EXPECT_EQ(map.static_lights, (std::vector<Entity>{lamps[0], lamps[2]}));
  EXPECT_EQ(scene.bake(wall).maps.at(0).emitter, other);
  EXPECT_NE(particle_light_content(scene.world, wall, options), particle_light_content(scene.world, wall));
}

TEST(ParticleLightContent, changes_with_lights_sky_emitters_and_triangles_only) {
  BakeScene scene;
  WallTracer wall(1.0);
  const Entity emitter = scene.add_emitter({2.0, 0.0, 0.0});
  const Entity lamp = scene.add_lamp({0.0, 0.0, 0.0});
  std::vector<std::uint64_t> seen = {particle_light_content(scene.world, wall)};
  const auto add = [&] { seen.push_back(particle_light_content(scene.world, wall)); };
  scene.world.get<Light>(lamp).intensity = 90.0f, add();
  scene.world.get<Light>(lamp).color.y = 0.5f, add();
  scene.world.get<Light>(lamp).width_m = 0.5f, add();
  scene.world.get<Light>(lamp).cookie = 1, add();
  scene.world.get<WorldTransform>(lamp).matrix[3].x = 0.5, add();
  scene.world.get<WorldTransform>(emitter).matrix[3].x = 2.5, add();
  scene.world.get<ParticleEmitter>(emitter).box_m.z = 4.0f, add();
  scene.world.resource<SceneEnvironment>().sky_zenith.z = 1.0f, add();
  scene.world.resource<AnimationBindings>().poses = {{lamp, 0, 0}}, add();
  wall.triangles_version = 2, add();
  std::vector<std::uint64_t> sorted = seen;
  std::ranges::sort(sorted);
  EXPECT_EQ(std::ranges::unique(sorted).begin(), sorted.end()) << "two states have the same hash";

  scene.world.resource<SceneEnvironment>().exposure_ev100 = 3.0f;
  scene.world.get<ParticleEmitter>(emitter).rate = 7.0f;
  EXPECT_EQ(particle_light_content(scene.world, wall), seen.back());
}

}  // namespace
}  // namespace gloam
