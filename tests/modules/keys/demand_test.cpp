// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "engine/scene/assets.h"
#include "engine/scene/gltf/import.h"
#include "modules/closeups/components.h"
#include "modules/depth_of_field/components.h"
#include "modules/grass/components.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "modules/particles/components.h"
#include "modules/reflections/components.h"
#include "modules/shadows/components.h"

namespace gloam {
namespace {

struct ModuleDemand : ::testing::Test {
  ModuleList modules = make_all_modules();
  World world;

  ModuleDemand() {
    prepare_scene_world(world);
    for (const auto& module : modules) module->register_components(world);
  }
  /// The reason of the demand, prefixed with + if the module is needed and − if not.
  [[nodiscard]] std::string demand(std::string_view name) const {
    for (const auto& module : modules) {
      if (module->name() != name) continue;
      const Demand demand = module->demand(world, nullptr);
      return (demand.needed ? "+" : "-") + demand.reason;
    }
    return "no such module";
  }
};

TEST_F(ModuleDemand, an_empty_world_calls_for_lighting_alone) {
  for (const auto& module : modules) {
    const Demand demand = module->demand(world, nullptr);
    EXPECT_EQ(demand.needed, module->name() == "lighting") << module->name();
    EXPECT_FALSE(demand.reason.empty()) << module->name();
  }
  EXPECT_EQ(demand("lights"), "-no light");
  EXPECT_EQ(demand("shadows"), "-no light casts shadows");
  EXPECT_EQ(demand("closeups"), "-no close-up subject");
  EXPECT_EQ(demand("lighting"), "+every picture is lit");
  EXPECT_EQ(demand("reflections"), "-no reflective material");
  EXPECT_EQ(demand("grass"), "-no surface grows grass");
  EXPECT_EQ(demand("particles"), "-no emitter");
  EXPECT_EQ(demand("depth_of_field"), "-no camera has a focus");
  EXPECT_EQ(demand("glare"), "-no camera has glare");
}

TEST_F(ModuleDemand, lights_call_for_lights_and_shadows) {
  const Entity lamp = world.create(Light{});
  EXPECT_EQ(demand("lights"), "+1 light");
  EXPECT_EQ(demand("shadows"), "+1 light casts shadows");
  world.create(Light{});
  EXPECT_EQ(demand("lights"), "+2 lights");
  EXPECT_EQ(demand("shadows"), "+2 lights cast shadows");
  world.add(lamp, ShadowCaster{.enabled = false});
  EXPECT_EQ(demand("shadows"), "+1 light casts shadows");
}

TEST_F(ModuleDemand, components_that_are_off_call_for_nothing) {
  world.create(Light{}, ShadowCaster{.enabled = false});
  world.create(CloseupSubject{}, IbrProxy{}, IbrRoom{}, CubeProbe{}, GrassSurface{}, Collider{});
  world.create(Wind{}, ParticleEmitter{}, DepthOfField{});
  EXPECT_EQ(demand("shadows"), "-no light casts shadows");
  EXPECT_EQ(demand("closeups"), "-no close-up subject");
  EXPECT_EQ(demand("reflections"), "-no reflective material");
  EXPECT_EQ(demand("grass"), "-no surface grows grass");
  EXPECT_EQ(demand("particles"), "-no emitter");
  EXPECT_EQ(demand("depth_of_field"), "-no camera has a focus");
}

TEST_F(ModuleDemand, close_up_subjects_call_for_nothing_without_a_light_that_casts) {
  world.create(CloseupSubject{.enabled = true});
  EXPECT_EQ(demand("closeups"), "-1 close-up subject, but no light casts shadows");
  const Entity lamp = world.create(Light{}, ShadowCaster{.enabled = false});
  EXPECT_EQ(demand("closeups"), "-1 close-up subject, but no light casts shadows");
  world.get<ShadowCaster>(lamp).enabled = true;
  EXPECT_EQ(demand("closeups"), "+1 close-up subject");
}

TEST_F(ModuleDemand, says_how_many_call_for_it) {
  world.create(Light{});
  world.create(CloseupSubject{.enabled = true});
  world.create(IbrProxy{.size_m = vec2(1.0f)});
  world.create(GrassSurface{.density = 10.0f});
  world.create(ParticleEmitter{.kind = EmitterKind::fog});
  world.create(DepthOfField{.focus_m = 2.0f});
  EXPECT_EQ(demand("closeups"), "+1 close-up subject");
  EXPECT_EQ(demand("reflections"), "-no reflective material");
  auto& assets = world.resource<SceneAssets>();
  assets.materials.push_back({.metallic = 0.0f, .roughness = 0.1f});
  assets.meshes.emplace_back().primitives.emplace_back().material = 0;
  EXPECT_EQ(demand("reflections"), "+1 reflective material, 1 proxy, 0 probes");
  EXPECT_EQ(demand("grass"), "+1 surface grows grass");
  EXPECT_EQ(demand("particles"), "+1 emitter");
  EXPECT_EQ(demand("depth_of_field"), "+1 camera has a focus");
  world.create(CloseupSubject{.enabled = true});
  world.create(IbrProxy{.size_m = vec2(1.0f)});
  world.create(CubeProbe{.global = true});
  world.create(GrassSurface{.density = 10.0f});
  world.create(ParticleEmitter{.kind = EmitterKind::fire});
  world.create(DepthOfField{.focus_m = 3.0f});
  EXPECT_EQ(demand("closeups"), "+2 close-up subjects");
  EXPECT_EQ(demand("reflections"), "+1 reflective material, 2 proxies, 1 probe");
  assets.materials[0].roughness = 0.7f;
  EXPECT_EQ(demand("reflections"), "+1 reflective material, 2 proxies that no smooth material shows, 1 probe");
  EXPECT_EQ(demand("grass"), "+2 surfaces grow grass");
  EXPECT_EQ(demand("particles"), "+2 emitters");
  EXPECT_EQ(demand("depth_of_field"), "+2 cameras have a focus");
}

TEST_F(ModuleDemand, components_of_all_modules_can_be_registered_twice) {
  const std::size_t count = world.components().size();
  for (const auto& module : modules) module->register_components(world);
  EXPECT_EQ(world.components().size(), count);
}

}  // namespace
}  // namespace gloam
