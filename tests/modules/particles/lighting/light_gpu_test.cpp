// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "engine/math/packing.h"
#include "modules/particles/bake.h"
#include "modules/particles/emitters/kinds.h"
#include "modules/particles/emitters/rows.h"
#include "tests/modules/particles/support/light_twin.h"
#include "tests/modules/particles/support/particle_stage.h"
#include "tests/modules/reflections/bake/small_png.h"
#include "tests/support/temporary_folder.h"

namespace gloam::test {
namespace {

struct Lamp {
  dvec3 at;
  vec3 color;
  float candela;
};

class ParticleLight : public ParticleTest {
 protected:
  /// The emitter's row, without its lights.
  [[nodiscard]] static shaders::ParticleEmitterRow row_of(ParticleStage& stage, const ParticleCopy& copy) {
    const auto& visible = stage.world.view_resource<VisibleEmitters>(ViewId{0});
    const PlacedEmitter& emitter = stage.world.resource<EmitterSet>().emitters.at(0);
    return emitter_row(emitter, visible.emitters.at(0), {}, {}, copy.view, visible.step, 0);
  }
  /// Compares every lit point with a function of its position and n.
  template <class Expected>
  static void expect_light(ParticleStage& stage, const Expected& expected) {
    const ParticleCopy copy = stage.copy();
    const shaders::ParticleEmitterRow row = row_of(stage, copy);
    ASSERT_GT(copy.draws.drawn, 20u);
    for (std::uint32_t i = 0; i < copy.draws.drawn; ++i) {
      const shaders::Particle& p = copy.particles.at(copy.order.at(i));
      for (std::uint32_t point = 0; point < copy.lit_points; ++point) {
        const double x = copy.lit_points == 1 ? 0.0 : (point & 1u) != 0u ? kTwinCorner : -kTwinCorner;
        const double y = copy.lit_points == 1 ? 0.0 : (point & 2u) != 0u ? kTwinCorner : -kTwinCorner;
        const dvec3 at = dvec3(p.position) + static_cast<double>(p.radius_m) *
                                                 (x * dvec3(copy.constants.right) + y * dvec3(copy.constants.up));
        const dvec3 n = twin_outward(row, copy.constants, p, x, y);
        const dvec3 wanted = expected(at, n, dvec3(row.albedo));
        const dvec3 found(copy.light_at(i * copy.lit_points + point));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], wanted[c], 2e-3 * wanted[c] + 1e-6) << i << ", " << point;
      }
    }
  }
};

const std::vector<Lamp> kLamps = {{{-1.5, 0.5, 0.3}, vec3(1.0f, 0.5f, 0.2f), 20.0f},
                                  {{1.7, 0.2, -0.4}, vec3(0.2f, 0.5f, 1.0f), 25.0f},
                                  {{0.1, 2.2, 0.5}, vec3(0.4f, 1.0f, 0.4f), 8.0f}};

TEST_F(ParticleLight, is_the_sum_of_the_lamps_and_the_surroundings) {
  for (const char* lighting : {"sprite", "vertex"})
    for (const EmitterKind kind : {EmitterKind::smoke, EmitterKind::dust}) {
      ParticleStage stage;
      stage.set("particles.lighting", lighting);
      auto& sky = stage.world.resource<SceneEnvironment>();
      sky.sky_zenith = vec3(0.3f, 0.4f, 0.9f);
      sky.sky_horizon = vec3(0.6f);
      sky.sky_ground = vec3(0.1f, 0.05f, 0.02f);
      stage.emitter(cloud(kind, 150.0f));
      for (const Lamp& lamp : kLamps) stage.lamp(lamp.at, lamp.color, lamp.candela, 9.0f);
      stage.draw(front());
      const dvec3 eye = stage.copy().view.position;
      expect_light(stage, [&](const dvec3& at, const dvec3& n, const dvec3& albedo) {
        const dvec3 above = 0.5 * (dvec3(sky.sky_horizon) + dvec3(sky.sky_zenith));
        dvec3 sum = albedo * glm::mix(dvec3(sky.sky_ground), above, 0.5 + 0.5 * n.y);
        for (const Lamp& lamp : kLamps) {
          const TwinLamp twin{lamp.at - eye, dvec3(lamp.color * lamp.candela), 9.0};
          sum += twin_scattered(albedo, n, glm::normalize(twin.position - at), twin_illuminance(twin, at));
        }
        return sum;
      });
    }
}

TEST_F(ParticleLight, counts_only_the_four_strongest_lamps_and_directional_lights) {
  ParticleStage stage;
  stage.set("particles.lighting", "sprite");
  stage.emitter(cloud(EmitterKind::dust, 150.0f));
  Light moon;
  moon.kind = LightKind::directional;
  moon.intensity = 40.0f;
  stage.world.create(moon, WorldTransform{});  // shines along −Z
  for (int i = 0; i < 3; ++i) stage.lamp({0.0, 40.0, 0.0}, vec3(1.0f), 60000.0f, 200.0f);
  for (int i = 0; i < 5; ++i) stage.lamp({2.0, 0.0, 0.0}, vec3(1.0f), 0.001f, 50.0f);
  stage.draw(front());
  const dvec3 eye = stage.copy().view.position;
  expect_light(stage, [&](const dvec3& at, const dvec3& n, const dvec3& albedo) {
    const TwinLamp twin{dvec3(0.0, 40.0, 0.0) - eye, dvec3(60000.0), 200.0};
    return 3.0 * twin_scattered(albedo, n, glm::normalize(twin.position - at), twin_illuminance(twin, at)) +
           twin_scattered(albedo, n, dvec3(0.0, 0.0, 1.0), dvec3(40.0));
  });
}

/// Flux that changes linearly in the box, so that interpolation is exact.
dvec4 flux_at(const dvec3& share, int channel) {
  return dvec4(0.5 * share.x - 0.2, 0.3 * share.y, -0.4 * share.z, 2.0 + share.x + 0.5 * channel);
}

ParticleLightMap gradient_map(Entity emitter, uvec3 size, const dvec3& origin) {
  ParticleLightMap map;
  map.emitter = emitter;
  map.origin = origin;
  map.box = {vec3(-2.0f), vec3(2.0f)};
  map.size = size;
  map.light_scale = 0.25f;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::uint32_t z = 0; z < size.z; ++z)
      for (std::uint32_t y = 0; y < size.y; ++y)
        for (std::uint32_t x = 0; x < size.x; ++x) {
          const dvec4 flux = flux_at((dvec3(x, y, z) + 0.5) / dvec3(size), static_cast<int>(c));
          BakedFlux texel;
          for (int i = 0; i < 4; ++i)
            texel[static_cast<std::size_t>(i)] = float_to_half(map.light_scale * static_cast<float>(flux[i]));
          map.flux[c].push_back(texel);
        }
  for (std::size_t i = 0; i < map.texels(); ++i) map.visibility.push_back({0, 0, 102, 0});
  return map;
}

TEST_F(ParticleLight, of_a_map_replaces_static_lights_and_surroundings) {
  ParticleStage stage;
  stage.world.resource<SceneEnvironment>().sky_horizon = vec3(50.0f);
  const Entity first = stage.world.create(WorldTransform{});
  const Entity emitter = stage.emitter(cloud(EmitterKind::smoke, 150.0f));
  const Entity fixed = stage.lamp({1.0, 0.0, 0.0}, vec3(1.0f), 900.0f, 9.0f);
  const Entity moving = stage.lamp({-1.5, 0.5, 0.3}, vec3(1.0f), 20.0f, 9.0f);
  ParticleLightMaps maps;
  // Another map before it in the atlas, of another size, whose light must not leak.
  ParticleLightMap other = gradient_map(first, uvec3(9, 3, 5), dvec3(0.0));
  for (auto& channel : other.flux)
    for (BakedFlux& texel : channel) texel = {0, 0, 0, float_to_half(60000.0f)};
  maps.maps = {other, gradient_map(emitter, uvec3(4, 6, 5), dvec3(0.0))};
  maps.maps[1].static_lights = {fixed};
  maps.maps[1].lights = {kNoEntity, kNoEntity, moving};
  maps.version = 1;
  mark_as_current(stage.world, maps);
  stage.world.resource<ParticleLightMaps>() = maps;
  const auto check = [&](double scale, double visibility) {
    stage.draw(front());
    const dvec3 eye = stage.copy().view.position;
    expect_light(stage, [&](const dvec3& at, const dvec3& n, const dvec3& albedo) {
      const dvec3 size(maps.maps[1].size);
      const dvec3 texel = glm::clamp((at + eye + 2.0) / 4.0 * size, dvec3(0.5), size - 0.5);
      dvec3 sum(0.0);
      for (int c = 0; c < 3; ++c)
        sum[c] = scale * albedo[c] * glm::dot(flux_at(texel / size, c), dvec4(n, 1.0)) / (4.0 * kTwinPi);
      const TwinLamp twin{dvec3(-1.5, 0.5, 0.3) - eye, dvec3(20.0), 9.0};
      return sum +
             visibility * twin_scattered(albedo, n, glm::normalize(twin.position - at), twin_illuminance(twin, at));
    });
  };
  check(1.0, 102.0 / 255.0);
  // Another version is uploaded again.
  for (BakedVisibility& texel : stage.world.resource<ParticleLightMaps>().maps[1].visibility) texel[2] = 255;
  stage.world.resource<ParticleLightMaps>().version = 2;
  check(1.0, 1.0);
  // An emitter that loses its map has all lights again.
  stage.world.resource<ParticleLightMaps>() = {{}, 3};
  stage.draw(front());
  EXPECT_GT(stage.copy().light_at(0).x, 10.0f) << "the light of the sky";
}

TEST_F(ParticleLight, of_a_spot_comes_through_its_cookie) {
  TestFolder folder;
  const std::string path = folder.path() + "/cookie.png";
  write_small_png(path);  // red, grey, blue and green
  ParticleStage stage;
  ParticleEmitter dust = cloud(EmitterKind::dust, 900.0f);
  dust.box_m = vec3(2.5f);
  stage.emitter(dust);
  Light spot;
  spot.kind = LightKind::spot;
  spot.intensity = 100.0f;
  spot.inner_angle = spot.outer_angle = 0.6f;
  const Entity lamp = stage.world.create(spot, WorldTransform{glm::translate(dmat4(1.0), dvec3(0.0, 0.0, 4.0))});
  for (const char* lighting : {"sprite", "vertex", "pixel"}) {
    stage.set("particles.lighting", lighting);
    stage.world.get<Light>(lamp).cookie = 0;
    stage.draw(front());
    const std::vector<float> plain_picture = stage.linear();
    const ParticleCopy plain = stage.copy();
    stage.world.get<Light>(lamp).cookie = stage.world.resource<SceneStrings>().intern(path);
    stage.draw(front());
    EXPECT_FALSE(stage.linear() == plain_picture) << lighting;
    const ParticleCopy colored = stage.copy();
    std::size_t red = 0, green = 0, points = 0;
    for (std::size_t i = 0; i < std::size_t{colored.draws.drawn} * colored.lit_points; ++i, ++points) {
      const vec3 before = plain.light_at(i), after = colored.light_at(i);
      for (int c = 0; c < 3; ++c) EXPECT_LE(after[c], before[c] * 1.01f + 1e-6f);
      red += after.x > 0.8f * before.x && after.y < 0.1f * before.y && before.x > 0.01f ? 1 : 0;
      green += after.y > 0.8f * before.y && after.x < 0.1f * before.x && before.x > 0.01f ? 1 : 0;
    }
    if (points == 0) continue;
    EXPECT_GT(red, points / 50) << lighting;
    EXPECT_GT(green, points / 50) << lighting;
  }
}

TEST_F(ParticleLight, of_lamps_that_are_not_finite_is_none) {
  ParticleStage stage;
  stage.emitter(cloud(EmitterKind::smoke, 150.0f));
  stage.lamp({1.0, 0.0, 0.0}, vec3(std::nanf("")), 10.0f);
  stage.lamp({std::nan(""), 0.0, 0.0}, vec3(1.0f), 10.0f);
  stage.lamp({0.0, 0.0, 0.0}, vec3(1.0f), std::numeric_limits<float>::infinity());
  stage.draw(front());
  for (const float value : stage.linear()) ASSERT_TRUE(std::isfinite(value));
}

TEST_F(ParticleLight, pixel_and_vertex_rates_agree_where_light_changes_slowly) {
  ParticleStage stage;
  stage.emitter(cloud(EmitterKind::smoke, 150.0f));
  stage.lamp({-30.0, 5.0, 3.0}, vec3(1.0f, 0.5f, 0.2f), 9000.0f, 200.0f);
  stage.draw(front());
  const std::vector<float> vertex = stage.linear();
  stage.set("particles.lighting", "pixel");
  stage.draw(front());
  const std::vector<float> pixel = stage.linear();
  stage.set("particles.lighting", "sprite");
  stage.draw(front());
  const std::vector<float> sprite = stage.linear();
  double sum = 0.0, vertex_error = 0.0, sprite_error = 0.0;
  for (std::size_t i = 0; i < pixel.size(); ++i) {
    if (i % 4 == 3) continue;
    sum += static_cast<double>(pixel[i]);
    vertex_error += static_cast<double>(std::abs(vertex[i] - pixel[i]));
    sprite_error += static_cast<double>(std::abs(sprite[i] - pixel[i]));
  }
  EXPECT_GT(sum, 10.0);
  EXPECT_LT(vertex_error, 0.01 * sum);
  EXPECT_LT(vertex_error, sprite_error);
}

TEST_F(ParticleLight, smoke_between_two_lamps_has_the_color_of_the_near_one_on_each_side) {
  ParticleStage stage;
  ParticleEmitter smoke = cloud(EmitterKind::smoke, 200.0f, 3.0f);
  smoke.box_m = vec3(0.5f, 0.1f, 0.5f);
  smoke.spread = 0.3f;
  stage.emitter(smoke, {0.0, -1.0, 0.0});
  stage.lamp({-2.0, 0.0, 0.0}, vec3(1.0f, 0.2f, 0.2f), 30.0f);
  stage.lamp({2.0, 0.0, 0.0}, vec3(0.2f, 0.2f, 1.0f), 30.0f);
  stage.draw(look_at(dvec3(0.0, 0.0, 4.0), dvec3(0.0), 64, 48));
  const std::vector<float> picture = stage.linear();
  double red[2] = {}, blue[2] = {};
  for (std::size_t i = 0; i < picture.size() / 4; ++i) {
    const std::size_t side = i % 64 < 32 ? 0 : 1;
    red[side] += static_cast<double>(picture[4 * i]);
    blue[side] += static_cast<double>(picture[4 * i + 2]);
  }
  EXPECT_GT(red[0], 1.3 * blue[0]);
  EXPECT_GT(blue[1], 1.3 * red[1]);
}

}  // namespace
}  // namespace gloam::test
