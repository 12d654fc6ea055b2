// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "sandbox/scenes/builtin.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/lamps/many_lights.h"

namespace gloam {
namespace {

struct BuiltWorld {
  World world;
  SceneInfo info;

  explicit BuiltWorld(std::string_view name) {
    prepare_scene_world(world);
    for (const auto& module : make_all_modules()) module->register_components(world);
    const auto scene = find_builtin_scene(name);
    EXPECT_TRUE(scene.ok());
    if (scene.ok()) scene.value()->build(world, info);
  }
};

std::map<LightKind, int> lights_by_kind(World& world) {
  std::map<LightKind, int> kinds;
  world.view<const Light>().each([&](const Light& light) { ++kinds[light.kind]; });
  return kinds;
}

TEST(BuiltinScenes, names_are_unique_and_each_says_what_it_shows) {
  std::set<std::string_view> names;
  for (const BuiltinScene& scene : builtin_scenes()) {
    EXPECT_TRUE(names.insert(scene.name).second);
    EXPECT_FALSE(scene.shows.empty());
  }
  EXPECT_TRUE(names.contains("plain"));
  EXPECT_TRUE(names.contains("lanterns"));
}

TEST(BuiltinScenes, an_unknown_name_is_wrong_usage_that_lists_the_names) {
  const auto scene = find_builtin_scene("lantern");
  ASSERT_FALSE(scene.ok());
  EXPECT_EQ(scene.error().kind, ErrorKind::usage);
  EXPECT_NE(scene.error().message.find("did you mean lanterns? there are dusk, plain, lanterns"), std::string::npos)
      << scene.error().message;
  EXPECT_EQ(find_builtin_scene("moon").error().message.find("did you mean"), std::string::npos);
}

TEST(BuiltinScenes, every_instance_names_a_mesh_and_every_mesh_a_material) {
  for (const BuiltinScene& scene : builtin_scenes()) {
    BuiltWorld built(scene.name);
    const auto& assets = built.world.resource<SceneAssets>();
    std::uint64_t triangles = 0;
    built.world.view<const MeshInstance>().each([&](const MeshInstance& instance) {
      ASSERT_LT(instance.mesh, assets.meshes.size());
      for (const Primitive& primitive : assets.meshes[instance.mesh].primitives)
        triangles += primitive.indices.size() / 3;
    });
    EXPECT_EQ(triangles, built.info.triangles);
    for (const Mesh& mesh : assets.meshes) {
      for (const Primitive& primitive : mesh.primitives) EXPECT_LT(primitive.material, assets.materials.size());
    }
    EXPECT_EQ(built.info.name, scene.name);
  }
}

TEST(BuiltinScenes, cameras_can_be_found_by_name) {
  for (const BuiltinScene& scene : builtin_scenes()) {
    BuiltWorld built(scene.name);
    const SceneNames& names = built.world.resource<SceneNames>();
    std::vector<Entity> found;
    for (const std::string& name : names.names("camera")) {
      const auto camera = names.find("camera", name);
      ASSERT_TRUE(camera.ok());
      found.push_back(*camera);
    }
    ASSERT_FALSE(found.empty());
    EXPECT_EQ(found, built.info.cameras);
  }
}

TEST(PlainScene, has_one_sun) {
  BuiltWorld built("plain");
  EXPECT_EQ(lights_by_kind(built.world), (std::map<LightKind, int>{{LightKind::directional, 1}}));
}

TEST(LanternsScene, has_256_coloured_point_and_spot_lights) {
  BuiltWorld built("lanterns");
  EXPECT_EQ(lights_by_kind(built.world), (std::map<LightKind, int>{{LightKind::point, 208}, {LightKind::spot, 48}}));
  EXPECT_EQ(built.world.resource<SceneNames>().names("light").size(), 256u);
  EXPECT_EQ(built.info.cameras.size(), 2u);
  built.world.view<const Light>().each([](const Light& light) {
    EXPECT_GT(light.range_m, 0.0f);
    EXPECT_GT(light.intensity, 0.0f);
    EXPECT_LE(light.inner_angle, light.outer_angle);
  });
}

TEST(ManyLightsScene, has_1024_point_and_spot_lights_that_reach_1_to_5_m_and_a_moon) {
  BuiltWorld built("many_lights");
  EXPECT_EQ(lights_by_kind(built.world),
            (std::map<LightKind, int>{{LightKind::point, 608}, {LightKind::spot, 416}, {LightKind::directional, 1}}));
  built.world.view<const Light>().each([](const Light& light) {
    if (light.kind == LightKind::directional) return;
    EXPECT_GE(light.range_m, 1.0f);
    EXPECT_LE(light.range_m, 5.0f);
    EXPECT_GT(light.intensity, 0.0f);
  });
}

TEST(ManyLightsScene, has_glass) {
  BuiltWorld built("many_lights");
  std::size_t panes = 0;
  const auto& assets = built.world.resource<SceneAssets>();
  built.world.view<const MeshInstance>().each([&](const MeshInstance& instance) {
    const std::uint32_t material = assets.meshes[instance.mesh].primitives[0].material;
    panes += assets.materials[material].alpha_mode == AlphaMode::blend ? 1 : 0;
  });
  EXPECT_GE(panes, 20u);
}

TEST(ManyLightsScene, can_be_thinned_out) {
  BuiltWorld built("many_lights");
  for (const std::size_t count : {2000u, 1000u, 256u, 8u, 0u}) {
    thin_out_lights(built.world, count);
    std::size_t left = 0;
    double reach = 0.0;
    built.world.view<const Light, const LocalTransform>().each([&](const Light& light, const LocalTransform& local) {
      if (light.kind == LightKind::directional) return;
      ++left;
      reach = std::max(reach, glm::length(local.translation));
    });
    EXPECT_EQ(left, std::min<std::size_t>(count, 1024));
    EXPECT_TRUE(count < 8 || reach > 15.0) << "they are not all at one end";
  }
}

TEST(ShadowsScene, has_a_wide_lamp_a_spot_and_a_moon_that_cast_soft_shadows) {
  BuiltWorld built("shadows");
  EXPECT_EQ(lights_by_kind(built.world),
            (std::map<LightKind, int>{{LightKind::point, 1}, {LightKind::spot, 1}, {LightKind::directional, 1}}));
  built.world.view<const Light>().each(
      [](const Light& light) { EXPECT_TRUE(light.kind == LightKind::directional || light.width_m >= 0.1f); });
}

TEST(SceneBuilder, a_rotation_towards_a_direction_turns_minus_z_there) {
  for (const dvec3& direction : {dvec3(0, 0, -1), dvec3(0, 0, 1), dvec3(0, -1, 0), dvec3(0, 2, 0), dvec3(1, -3, 0.5)}) {
    const dvec3 turned = rotation_towards(direction) * dvec3(0, 0, -1);
    EXPECT_LT(glm::length(turned - glm::normalize(direction)), 1e-9);
  }
}

TEST(SceneBuilder, a_clip_has_the_channels_of_its_node) {
  World world;
  SceneInfo info;
  prepare_scene_world(world);
  SceneBuilder builder(world, info);
  builder.add_group("first", {});
  const Entity node = builder.add_group("second", {});
  const PoseKey keys[] = {{0.0, {1.0, 2.0, 3.0}}, {0.5, {4.0, 5.0, 6.0}}, {2.0, {1.0, 2.0, 3.0}}};
  builder.add_clip("swing", node, keys);
  const auto& clips = world.resource<SceneAssets>().clips;
  ASSERT_EQ(clips.size(), 1u);
  EXPECT_EQ(clips[0].name, "swing");
  EXPECT_EQ(clips[0].duration_s, 2.0f);
  ASSERT_EQ(clips[0].channels.size(), 2u);
  EXPECT_EQ(clips[0].channels[0].values, (std::vector<float>{1, 2, 3, 4, 5, 6, 1, 2, 3}));
  EXPECT_EQ(clips[0].channels[1].values, (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}));
  for (const AnimationChannel& channel : clips[0].channels) {
    EXPECT_EQ(channel.times, (std::vector<float>{0.0f, 0.5f, 2.0f}));
    EXPECT_EQ(info.node_entities[channel.node], node);
  }
  EXPECT_EQ(world.get<SourceNode>(node).index, 1u);
}

}  // namespace
}  // namespace gloam
