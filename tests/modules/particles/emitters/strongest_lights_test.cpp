// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/strongest_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

namespace gloam::test {
namespace {

EmitterLight lamp(std::uint32_t index, const dvec3& at, double candela, double range_m = 100.0) {
  EmitterLight light;
  light.entity = Entity{index, 1};
  light.position = at;
  light.emitted = candela;
  light.range_m = range_m;
  return light;
}

WorldBox box_at(const dvec3& middle, double half) { return {middle - half, middle + half}; }

TEST(StrongestLights, are_the_four_strongest_in_order) {
  std::vector<EmitterLight> lights;
  for (std::uint32_t i = 0; i < 9; ++i) lights.push_back(lamp(i, {3.0 + (i * 5) % 9, 0.0, 0.0}, 10.0));
  const LightsOfEmitter found = strongest_lights(lights, box_at({}, 0.5), nullptr);
  ASSERT_EQ(found.count, 4u);
  for (std::uint32_t i = 0; i < 4; ++i) {
    EXPECT_EQ(lights[found.lights[i].entity.index].position.x, 3.0 + i);
    EXPECT_EQ(found.lights[i].channel, kBakedLights);
  }
}

TEST(StrongestLights, a_light_that_cannot_reach_the_box_is_left_out) {
  EXPECT_EQ(light_strength(lamp(0, {5.0, 0.0, 0.0}, 10.0, 3.9), box_at({}, 1.0)), 0.0);
  EXPECT_GT(light_strength(lamp(0, {5.0, 0.0, 0.0}, 10.0, 4.5), box_at({}, 1.0)), 0.0);
  EmitterLight spot = lamp(0, {5.0, 0.0, 0.0}, 10.0);
  spot.kind = LightKind::spot;
  spot.outer_angle = 0.3;
  spot.direction = vec3(0.0f, 1.0f, 0.0f);
  EXPECT_EQ(light_strength(spot, box_at({}, 1.0)), 0.0);
  spot.direction = vec3(-1.0f, 0.0f, 0.0f);
  EXPECT_GT(light_strength(spot, box_at({}, 1.0)), 0.0);
  EXPECT_EQ(strongest_lights({}, box_at({}, 1.0), nullptr).count, 0u);
}

TEST(StrongestLights, a_spot_that_lights_a_corner_of_the_box_is_never_left_out) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  int lit = 0;
  for (int i = 0; i < 20000; ++i) {
    EmitterLight spot = lamp(0, 4.0 * dvec3(unit(random), unit(random), unit(random)), 1.0, 6.0);
    spot.kind = LightKind::spot;
    spot.outer_angle = 0.8 * std::abs(unit(random));
    spot.direction = vec3(glm::normalize(dvec3(unit(random), unit(random), unit(random)) + 1e-3));
    const WorldBox box = box_at({}, 1.0);
    const dvec3 corner(unit(random), unit(random), unit(random));
    const dvec3 way = corner - spot.position;
    const bool lights_it = glm::length(way) < spot.range_m &&
                           std::acos(glm::dot(glm::normalize(way), dvec3(spot.direction))) < spot.outer_angle - 1e-6;
    lit += lights_it ? 1 : 0;
    if (lights_it) {
      EXPECT_GT(light_strength(spot, box), 0.0);
    }
  }
  EXPECT_GT(lit, 500);
}

TEST(StrongestLights, weights_change_without_a_jump_when_lights_swap_places) {
  std::vector<float> before;
  for (int step = 0; step <= 1000; ++step) {
    std::vector<EmitterLight> lights;
    for (std::uint32_t i = 0; i < 5; ++i) lights.push_back(lamp(i, {4.0, 0.0, 0.0}, 20.0 - i));
    lights[4].emitted = 10.0 + 0.015 * step;  // becomes the strongest
    const LightsOfEmitter found = strongest_lights(lights, box_at({}, 0.5), nullptr);
    std::vector<float> weights(5, 0.0f);
    for (std::uint32_t i = 0; i < found.count; ++i) weights[found.lights[i].entity.index] = found.lights[i].weight;
    for (std::size_t i = 0; !before.empty() && i < 5; ++i) EXPECT_NEAR(weights[i], before[i], 0.01f) << step;
    before = weights;
  }
  EXPECT_GT(before[4], 0.9f);
}

TEST(StrongestLights, static_lights_of_a_map_are_left_out_and_dynamic_ones_have_their_channel) {
  std::vector<EmitterLight> lights;
  for (std::uint32_t i = 0; i < 4; ++i) lights.push_back(lamp(i, {4.0, 0.0, 0.0}, 20.0 - i));
  ParticleLightMap map;
  map.visibility.resize(1);
  map.static_lights = {Entity{0, 1}, Entity{2, 1}};
  map.lights = {Entity{9, 1}, Entity{3, 1}};
  const LightsOfEmitter found = strongest_lights(lights, box_at({}, 0.5), &map);
  ASSERT_EQ(found.count, 2u);
  EXPECT_EQ(found.lights[0].entity.index, 1u);
  EXPECT_EQ(found.lights[0].channel, kBakedLights) << "not baked";
  EXPECT_EQ(found.lights[1].entity.index, 3u);
  EXPECT_EQ(found.lights[1].channel, 1u);
}

TEST(StrongestLights, maps_of_wrong_sizes_are_not_used) {
  ParticleLightMap map;
  map.emitter = Entity{7, 1};
  map.box = {vec3(0.0f), vec3(1.0f)};
  map.size = uvec3(2, 3, 4);
  for (auto& channel : map.flux) channel.resize(24);
  EXPECT_TRUE(is_usable(map));
  ParticleLightMaps maps;
  maps.maps = {map};
  EXPECT_EQ(find_light_map(maps, Entity{7, 1}), &maps.maps[0]);
  EXPECT_EQ(find_light_map(maps, Entity{7, 2}), nullptr);
  EXPECT_EQ(find_light_map(maps, Entity{6, 1}), nullptr);
  map.visibility.resize(23);
  EXPECT_FALSE(is_usable(map));
  map.visibility.resize(24);
  EXPECT_TRUE(is_usable(map));
  map.flux[1].resize(23);
  EXPECT_FALSE(is_usable(map));
  map.flux[1].resize(24);
  map.size.x = 0;
  EXPECT_FALSE(is_usable(map));
  map.size.x = 2;
  map.box.max.y = std::nanf("");
  EXPECT_FALSE(is_usable(map));
}

}  // namespace
}  // namespace gloam::test
