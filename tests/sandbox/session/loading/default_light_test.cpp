// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/session/loading/default_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "engine/ecs/view.h"
#include "engine/scene/assets.h"
#include "engine/scene/components.h"
#include "engine/scene/resources.h"
#include "modules/lights/components.h"
#include "modules/module_list/module_list.h"
#include "sandbox/scenes/construction/scene_builder.h"
#include "sandbox/scenes/construction/shapes.h"
#include "sandbox/session/loading/model_brightness.h"
#include "sandbox/session/loading/scene_loading.h"
#include "sandbox/session/loading/scene_summary.h"

namespace gloam {
namespace {

class DefaultLightTest : public ::testing::Test {
 protected:
  DefaultLightTest() { prepare_world(world_, modules_); }
  void draw_box() { builder_.add_instance("box", builder_.add_mesh("box", box_shape(vec3(1.0f)), 0), {}); }
  [[nodiscard]] std::size_t lights() const {
    std::size_t count = 0;
    world_.view<const Light>().each([&](const Light&) { ++count; });
    return count;
  }
  ModuleList modules_ = make_all_modules();
  World world_;
  SceneInfo info_;
  SceneBuilder builder_{world_, info_};
};

TEST_F(DefaultLightTest, lights_a_scene_without_lights_and_sky) {
  draw_box();
  EXPECT_TRUE(add_default_light(world_, info_));
  EXPECT_EQ(lights(), 1u);
  const auto& environment = world_.resource<SceneEnvironment>();
  EXPECT_GT(environment.sky_zenith.z, environment.sky_zenith.x);
  EXPECT_TRUE(environment.has_exposure);
  EXPECT_FALSE(add_default_light(world_, info_)) << "a second call finds light";
}

TEST_F(DefaultLightTest, exposes_by_how_bright_the_model_is) {
  // Metal reflects its base colour.
  const auto exposure_of = [this](float color, float metallic) {
    World world;
    prepare_world(world, modules_);
    SceneInfo info;
    SceneBuilder builder(world, info);
    Material material;
    material.base_color = vec4(vec3(color), 1.0f);
    material.metallic = metallic;
    world.resource<SceneAssets>().materials.push_back(material);
    builder.add_instance("box", builder.add_mesh("box", box_shape(vec3(1.0f)), 0), {});
    EXPECT_TRUE(add_default_light(world, info));
    return world.resource<SceneEnvironment>().exposure_ev100;
  };
  const float middle = exposure_of(0.3f, 1.0f);
  const float twice = exposure_of(0.6f, 1.0f);
  EXPECT_GT(twice - middle, 0.4f);
  EXPECT_LT(twice - middle, 1.0f);  // less than by how much brighter it is, so that it looks brighter
  const float dark = exposure_of(0.05f, 1.0f);
  const float black = exposure_of(0.0f, 0.0f);
  EXPECT_LT(dark - middle, -1.2f);
  EXPECT_GE(black - middle, -2.01f);
  EXPECT_LE(black, dark);
}

TEST_F(DefaultLightTest, weighs_the_parts_of_a_model_by_their_area) {
  auto& materials = world_.resource<SceneAssets>().materials;
  materials.resize(3);
  materials[1].base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  materials[2].base_color = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  materials[2].emissive = vec3(1.0f);
  EXPECT_FALSE(mean_reflectance(world_));
  const auto add = [this](std::uint32_t material, double size) {
    const Entity box = builder_.add_instance("box", builder_.add_mesh("box", box_shape(vec3(1.0f)), material), {});
    world_.get<WorldTransform>(box).matrix = glm::scale(dmat4(1.0), dvec3(size));
  };
  add(0, 1.0);  // white metal: 1
  EXPECT_NEAR(mean_reflectance(world_).value(), 1.0, 1e-9);
  add(1, 2.0);  // black metal: 0, and four times the area
  EXPECT_NEAR(mean_reflectance(world_).value(), 0.2, 1e-6);
  add(2, 50.0);  // a black surface that emits
  EXPECT_NEAR(mean_reflectance(world_).value(), 0.2, 1e-6);
}

TEST_F(DefaultLightTest, keeps_the_exposure_of_the_scene) {
  draw_box();
  auto& environment = world_.resource<SceneEnvironment>();
  environment.has_exposure = true;
  environment.exposure_ev100 = 3.5f;
  EXPECT_TRUE(add_default_light(world_, info_));
  EXPECT_EQ(environment.exposure_ev100, 3.5f);
}

TEST_F(DefaultLightTest, makes_emission_as_bright_as_white) {
  auto& materials = world_.resource<SceneAssets>().materials;
  materials.push_back({.emissive = vec3(1.0f, 0.5f, 0.0f)});
  draw_box();
  ASSERT_TRUE(add_default_light(world_, info_));
  // An exposure of EV100 maps 1.2 · 2^EV cd/m² to 1.
  const float white = 1.2f * std::exp2(world_.resource<SceneEnvironment>().exposure_ev100);
  EXPECT_NEAR(materials.back().emissive.x / white, 1.0f, 1e-4f);
  EXPECT_NEAR(materials.back().emissive.y / white, 0.5f, 1e-4f);
  EXPECT_EQ(materials.back().emissive.z, 0.0f);
}

TEST_F(DefaultLightTest, leaves_emission_to_the_exposure_of_the_scene) {
  auto& materials = world_.resource<SceneAssets>().materials;
  materials.push_back({.emissive = vec3(1.0f)});
  draw_box();
  world_.resource<SceneEnvironment>().has_exposure = true;
  ASSERT_TRUE(add_default_light(world_, info_));
  EXPECT_EQ(materials.back().emissive, vec3(1.0f));
}

TEST_F(DefaultLightTest, leaves_scenes_with_a_light_or_a_sky_and_empty_ones) {
  EXPECT_FALSE(add_default_light(world_, info_)) << "nothing is drawn";
  draw_box();
  auto& environment = world_.resource<SceneEnvironment>();
  environment.sky_ground = vec3(0.0f, 0.1f, 0.0f);
  EXPECT_FALSE(add_default_light(world_, info_)) << "a sky";
  environment.sky_ground = vec3(0.0f);
  environment.has_sky = true;
  EXPECT_FALSE(add_default_light(world_, info_)) << "a sky of zero that the file sets";
  environment.has_sky = false;
  builder_.add_light("lamp", Light{}, {}, {0.0, -1.0, 0.0}, false);
  EXPECT_FALSE(add_default_light(world_, info_)) << "a light";
  EXPECT_EQ(lights(), 1u);
}

TEST_F(DefaultLightTest, is_told_in_the_summary_but_not_counted_as_content) {
  draw_box();
  const SceneSummary before = summarize_scene("x", world_, info_, make_key_registry(modules_), modules_);
  ASSERT_TRUE(add_default_light(world_, info_));
  const SceneSummary after = summarize_scene("x", world_, info_, make_key_registry(modules_), modules_);
  EXPECT_FALSE(before.default_light);
  EXPECT_TRUE(after.default_light);
  EXPECT_EQ(after.nodes, before.nodes);
  EXPECT_EQ(after.lights, 0u);
  EXPECT_TRUE(after.light_names.empty());
  EXPECT_NE(summary_text(after).find(kDefaultLightSentence), std::string::npos);
}

}  // namespace
}  // namespace gloam
