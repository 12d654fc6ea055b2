// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/lights/module.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <random>

#include "engine/scene/components.h"
#include "modules/lights/light_set.h"
#include "modules/lights/selection/light_list.h"
#include "tests/jobs/executors.h"
#include "tests/support/module_world.h"

namespace gloam {
namespace {

/// A world of `count` lights over several archetypes. The entities have the same indices for any order of creation.
struct LitWorld : test::ModuleWorld {
  std::vector<Entity> entities;

  LitWorld(std::uint32_t count, std::uint32_t seed) : ModuleWorld(make_lights_module()) {
    for (std::uint32_t i = 0; i < count; ++i) entities.push_back(world.create());
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0u);
    if (seed != 0) std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    for (const std::uint32_t i : order) {
      Light light;
      light.intensity = static_cast<float>(i + 1);
      WorldTransform transform;
      transform.matrix[3] = dvec4(i % 7, i % 5, -3.0 - i % 11, 1.0);
      if (i % 3 == 0) world.add(entities[i], Parent{});
      if (i % 2 == 0) world.add(entities[i], transform);
      world.add(entities[i], light);
      if (i % 2 != 0) world.add(entities[i], transform);
    }
  }
  [[nodiscard]] const VisibleLights& visible() const { return world.view_resource<VisibleLights>(settings.id); }
};

TEST(LightsModule, gathers_lights_by_entity_whatever_the_order_of_creation) {
  const auto executor = make_serial_executor();
  for (const std::uint32_t seed : {0u, 1u, 2u}) {
    LitWorld lit(200, seed);
    lit.run(*executor);
    const auto& lights = lit.world.resource<LightSet>().lights;
    ASSERT_EQ(lights.size(), 200u);
    for (std::uint32_t i = 0; i < 200; ++i) {
      ASSERT_EQ(lights[i].entity, lit.entities[i]);
      ASSERT_EQ(lights[i].light.intensity, static_cast<float>(i + 1));
      ASSERT_EQ(lights[i].position, dvec3(i % 7, i % 5, -3.0 - i % 11));
    }
  }
}

TEST(LightsModule, selects_the_same_lights_with_every_executor) {
  LitWorld expected(300, 0);
  expected.run(*make_serial_executor());
  for (const test::ExecutorCase& c : test::all_executors()) {
    LitWorld lit(300, 3);
    const auto executor = c.make();
    lit.run(*executor);
    ASSERT_EQ(lit.visible().local_entities, expected.visible().local_entities) << c.name;
    EXPECT_EQ(std::memcmp(&lit.visible().block, &expected.visible().block, sizeof(shaders::LightBlock)), 0) << c.name;
  }
}

TEST(LightsModule, leaves_out_lights_without_a_place) {
  LitWorld lit(3, 0);
  lit.world.remove<WorldTransform>(lit.entities[1]);
  lit.run(*make_serial_executor());
  ASSERT_EQ(lit.world.resource<LightSet>().lights.size(), 2u);
  EXPECT_EQ(lit.world.resource<LightSet>().lights[1].entity, lit.entities[2]);
}

TEST(LightsModule, keeps_what_a_view_has_when_it_is_prepared_again) {
  LitWorld lit(4, 0);
  lit.run(*make_serial_executor());
  const VisibleLights* before = &lit.visible();
  lit.module->prepare_view(lit.world, ViewId{0}, lit.knobs);
  EXPECT_EQ(&lit.visible(), before);
  EXPECT_FALSE(lit.visible().local_entities.empty());
}

}  // namespace
}  // namespace gloam
