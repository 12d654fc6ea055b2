// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/systems.h"
#include "modules/lighting/components.h"
#include "modules/lights/components.h"
#include "modules/reflections/bake.h"
#include "modules/reflections/components.h"
#include "modules/shadows/components.h"

namespace gloam {
namespace {

/// A world with flames at these nodes.
struct FlameWorld {
  FlameWorld() {
    prepare_scene_world(world);
    world.register_component<Light>("light");
    world.register_component<ShadowCaster>("shadow_caster");
    world.register_component<IbrProxy>("ibr_proxy");
    world.register_component<FlameProxy>("flame_proxy");
    world.register_component<CubeProbe>("cube_probe");
    FlameSource source;
    source.find = [this](const World&) {
      std::vector<Flame> flames;
      for (const Entity entity : nodes) flames.push_back({entity, vec2(0.6f, 1.4f), 0.5f});
      return flames;
    };
    source.picture = [this](const World&, Entity, std::uint32_t side) {
      return std::vector<vec4>(std::size_t{side} * side, vec4(brightness));
    };
    world.set_resource(std::move(source));
  }
  [[nodiscard]] std::vector<Entity> proxies() const {
    std::vector<Entity> found;
    world.view<const IbrProxy>().each([&](Entity entity, const IbrProxy&) { found.push_back(entity); });
    return found;
  }
  World world;
  std::vector<Entity> nodes;
  float brightness = 1.0f;
};

TEST(FlameProxies, are_four_children_of_each_flame_that_face_all_sides) {
  FlameWorld scene;
  const Entity root = scene.world.create(LocalTransform{}, WorldTransform{});
  const Entity node =
      scene.world.create(LocalTransform{.translation = dvec3(3.0, 1.0, 0.0)}, WorldTransform{}, Parent{root, 1});
  scene.nodes = {node};
  add_flame_proxies(scene.world);
  Schedule schedule;
  add_scene_systems(schedule);
  auto executor = make_serial_executor();
  schedule.run(Stage::world, scene.world, *executor);
  dvec3 sum(0.0);
  ASSERT_EQ(scene.proxies().size(), 4u);
  for (const Entity proxy : scene.proxies()) {
    EXPECT_EQ(scene.world.get<IbrProxy>(proxy).kind, IbrProxyKind::fire);
    EXPECT_EQ(scene.world.get<IbrProxy>(proxy).size_m, vec2(0.6f, 1.4f));
    EXPECT_EQ(scene.world.get<FlameProxy>(proxy).flame, node);
    const dmat4& matrix = scene.world.get<WorldTransform>(proxy).matrix;
    EXPECT_LT(glm::length(dvec3(matrix[3]) - dvec3(3.0, 1.5, 0.0)), 1e-9);
    EXPECT_NEAR(matrix[1].y, 1.0, 1e-9) << "upright";
    sum += glm::abs(dvec3(matrix[2]));
  }
  EXPECT_LT(glm::length(sum - dvec3(2.0, 0.0, 2.0)), 1e-9);
}

TEST(FlameProxies, are_made_once_and_not_beside_those_of_the_scene) {
  FlameWorld scene;
  const Entity first = scene.world.create(LocalTransform{}, WorldTransform{});
  const Entity own = scene.world.create(LocalTransform{}, WorldTransform{}, IbrProxy{.kind = IbrProxyKind::fire});
  const Entity other = scene.world.create(LocalTransform{}, WorldTransform{});
  scene.world.create(LocalTransform{}, WorldTransform{}, Parent{other, 1}, IbrProxy{.kind = IbrProxyKind::fire});
  scene.nodes = {first, own, other};
  add_flame_proxies(scene.world);
  EXPECT_EQ(scene.proxies().size(), 2u + 4u);
  add_flame_proxies(scene.world);
  EXPECT_EQ(scene.proxies().size(), 2u + 4u);
}

TEST(FlameProxies, a_flame_that_looks_different_is_captured_anew) {
  FlameWorld scene;
  scene.nodes = {scene.world.create(LocalTransform{}, WorldTransform{})};
  add_flame_proxies(scene.world);
  const std::uint64_t before = capture_content(scene.world);
  EXPECT_EQ(capture_content(scene.world), before);
  scene.brightness = 2.0f;
  EXPECT_NE(capture_content(scene.world), before);
}

TEST(FlameProxies, a_world_without_flames_has_none) {
  FlameWorld scene;
  add_flame_proxies(scene.world);
  scene.world.set_resource(FlameSource{});
  add_flame_proxies(scene.world);
  EXPECT_TRUE(scene.proxies().empty());
}

}  // namespace
}  // namespace gloam
