// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/lamps/shadow_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "modules/shadows/components.h"

namespace gloam {
namespace {

struct Grid {
  World world;
  SceneInfo info;
  Grid() {
    prepare_scene_world(world);
    for (const auto& module : make_all_modules()) module->register_components(world);
    build_shadow_grid_scene(world, info);
  }
};

struct Lamp {
  dvec3 place;
  float range_m;
};

std::vector<Lamp> lamps(World& world) {
  std::vector<Lamp> found;
  world.view<const Light, const LocalTransform>().each([&](const Light& light, const LocalTransform& local) {
    found.push_back({local.translation, light.range_m});
  });
  return found;
}

/// Number of lights whose range reaches a point on the ground: the mean over the inner part of the square.
double mean_reached(World& world) {
  double sum = 0.0, points = 0.0;
  const std::vector<Lamp> all = lamps(world);
  for (double x = -14.0; x <= 14.0; x += 1.0) {
    for (double z = -14.0; z <= 14.0; z += 1.0, points += 1.0)
      for (const Lamp& lamp : all) sum += glm::length(lamp.place - dvec3(x, 0.0, z)) < lamp.range_m ? 1.0 : 0.0;
  }
  return sum / points;
}

TEST(ShadowGridScene, has_half_points_half_spots_that_all_cast_soft_shadows) {
  Grid grid;
  std::size_t spots = 0, all = 0;
  grid.world.view<const Light, Maybe<const ShadowCaster>>().each([&](const Light& light, const ShadowCaster* caster) {
    ++all;
    spots += light.kind == LightKind::spot ? 1 : 0;
    EXPECT_EQ(caster, nullptr);
    EXPECT_GT(light.width_m, 0.0f);
  });
  EXPECT_EQ(all, kShadowGridLights);
  EXPECT_EQ(spots, kShadowGridLights / 2);
}

TEST(ShadowGridScene, as_many_lights_reach_a_point_as_it_was_arranged_for) {
  for (const double wanted : {3.0, 12.0}) {
    Grid grid;
    arrange_shadow_grid_lights(grid.world, kShadowGridLights, wanted);
    EXPECT_NEAR(mean_reached(grid.world), wanted, wanted * 0.15);
  }
}

TEST(ShadowGridScene, fewer_lights_reach_as_far_and_lie_as_evenly) {
  Grid grid;
  arrange_shadow_grid_lights(grid.world, 64, 6.0);
  EXPECT_EQ(lamps(grid.world).size(), 64u);
  EXPECT_NEAR(mean_reached(grid.world), 6.0, 1.2);
  EXPECT_NEAR(shadow_grid_range_m(256, 24.0), shadow_grid_range_m(64, 6.0), 1e-9);
}

TEST(ShadowGridScene, its_boards_turn_with_time) {
  Grid grid;
  const auto board = grid.world.resource<SceneNames>().find("mesh", "board 0");
  ASSERT_TRUE(board.ok());
  const dquat before = grid.world.get<LocalTransform>(*board).rotation;
  turn_shadow_grid_boards(grid.world, 1.0);
  const dquat after = grid.world.get<LocalTransform>(*board).rotation;
  EXPECT_GT(std::abs(before.y - after.y), 0.1);
}

}  // namespace
}  // namespace gloam
