// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Worlds as a careless host fills them: each kind of misuse, and the sentence that names it.
#include <limits>

#include "engine/scene/gltf/import.h"
#include "tests/render/misuse/careless_host.h"

namespace gloam {
namespace {

using test::CarelessHost;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::SizeIs;

struct NeverRegistered {
  int value = 0;
};

TEST(WorldMisuse, a_dead_entity_is_named) {
  World world;
  world.register_component<Camera>("camera");
  const Entity entity = world.create(Camera{});
  world.destroy(entity);
  EXPECT_ASSERT((void)world.get<Camera>(entity), "entity 0 (generation 1) is not alive");
  EXPECT_ASSERT(world.destroy(entity), "entity 0 (generation 1) is not alive");
  EXPECT_ASSERT(world.add(entity, Camera{}), "entity 0 (generation 1) is not alive");
  EXPECT_ASSERT(world.destroy(kNoEntity), "kNoEntity is not alive in this world");
}

TEST(WorldMisuse, an_absent_or_unregistered_component_is_named) {
  World world;
  world.register_component<Camera>("camera");
  world.register_component<WorldTransform>("world_transform");
  const Entity entity = world.create(Camera{});
  EXPECT_ASSERT((void)world.get<WorldTransform>(entity), "no component gloam::WorldTransform");
  EXPECT_ASSERT((void)world.create(NeverRegistered{}), "NeverRegistered is not registered in this world");
  EXPECT_ASSERT((void)world.resource<SceneAssets>(), "the world has no resource gloam::SceneAssets");
}

TEST(WorldMisuse, a_world_that_was_not_prepared) {
  CarelessHost stage;
  World bare;
  const ViewRequest view = CarelessHost::request();
  EXPECT_ASSERT((void)stage.renderer->render(bare, {&view, 1}), "Renderer::prepare_world");
  EXPECT_ASSERT((void)stage.renderer->check_visualizer(bare, "light_list:lamp"), "Renderer::prepare_world");
}

TEST(WorldMisuse, a_world_that_is_prepared_again_is_released) {
  CarelessHost stage;
  ASSERT_TRUE(stage.render(CarelessHost::request()).ok());
  stage.renderer->prepare_world(stage.world);
  EXPECT_FALSE(stage.renderer->read_picture(ViewId{0}).ok());
  ASSERT_TRUE(stage.render(CarelessHost::request()).ok());
  EXPECT_THAT(stage.lines, SizeIs(0));
}

// A host may fill the world before it has a renderer.
TEST(WorldMisuse, a_filled_world_keeps_what_it_has_when_it_is_prepared) {
  CarelessHost stage;
  const auto draws = [&] {
    EXPECT_TRUE(stage.render(CarelessHost::request()).ok());
    return stage.renderer->report().counters.at("engine.draws");
  };
  const double before = draws();
  EXPECT_GT(before, 0.0);
  auto& environment = stage.world.resource<SceneEnvironment>();
  environment.sky_zenith = vec3(1.0f, 2.0f, 3.0f);
  const std::size_t meshes = stage.world.resource<SceneAssets>().meshes.size();
  stage.renderer->prepare_world(stage.world);
  EXPECT_EQ(stage.world.resource<SceneAssets>().meshes.size(), meshes);
  EXPECT_EQ(stage.world.resource<SceneEnvironment>().sky_zenith, vec3(1.0f, 2.0f, 3.0f));
  EXPECT_EQ(draws(), before);

  World filled;
  prepare_scene_world(filled);
  test::SceneMaker scene(filled);
  scene.draw(scene.mesh(test::box(vec3(0.5f))));
  stage.renderer->prepare_world(filled);
  const ViewRequest view = CarelessHost::request(1);
  ASSERT_TRUE(stage.renderer->render(filled, {&view, 1}).ok());
  EXPECT_EQ(stage.renderer->report().counters.at("engine.draws"), 1.0);
}

TEST(WorldMisuse, a_world_whose_renderer_is_gone_is_drawn_by_the_next_one) {
  CarelessHost one, other;
  one.renderer.reset();
  const ViewRequest view = CarelessHost::request();
  EXPECT_TRUE(other.renderer->render(one.world, {&view, 1}).ok());
  EXPECT_TRUE(other.renderer->render(other.world, {&view, 1}).ok());
}

TEST(WorldMisuse, a_world_that_another_renderer_has_prepared) {
  CarelessHost one, other;
  const ViewRequest view = CarelessHost::request();
  EXPECT_ASSERT((void)one.renderer->render(other.world, {&view, 1}), "prepared by another renderer");
  EXPECT_ASSERT(one.renderer->release_world(other.world), "prepared by another renderer");
}

TEST(WorldMisuse, a_world_that_is_destroyed_without_release_is_released_later) {
  CarelessHost stage;
  const ViewRequest view = CarelessHost::request();
  ASSERT_TRUE(stage.render(view).ok());
  {
    World other;
    stage.renderer->prepare_world(other);
    test::fill_small_scene(other);
    const ViewRequest second = CarelessHost::request(1);
    ASSERT_TRUE(stage.renderer->render(other, {&second, 1}).ok());
  }
  ASSERT_TRUE(stage.render(view).ok());
  EXPECT_THAT(stage.lines, Contains(HasSubstr("a world was destroyed without Renderer::release_world")));
  EXPECT_FALSE(stage.renderer->read_picture(ViewId{1}).ok());
}

TEST(WorldMisuse, a_mesh_instance_that_names_no_mesh) {
  CarelessHost stage;
  const Entity entity = stage.world.create(WorldTransform{}, MeshInstance{99});
  for (int frame = 0; frame < 2; ++frame) ASSERT_TRUE(stage.render(CarelessHost::request()).ok());
  EXPECT_THAT(stage.lines, Contains(text_of(entity) +
                                    " has a MeshInstance of mesh 99, and SceneAssets has 7 meshes: it is not drawn"));
  EXPECT_THAT(stage.lines, SizeIs(1));
}

TEST(WorldMisuse, a_mesh_instance_that_names_no_skin) {
  CarelessHost stage;
  const Entity entity = stage.world.create(WorldTransform{}, MeshInstance{0, 5});
  EXPECT_ASSERT((void)stage.render(CarelessHost::request()), "skin 5, and SceneAssets has 1");
  EXPECT_ASSERT((void)stage.render(CarelessHost::request()), "entity " + std::to_string(entity.index));
}

TEST(WorldMisuse, assets_that_cannot_be_drawn) {
  CarelessHost stage;
  stage.world.resource<SceneAssets>().meshes[0].primitives[0].normals.clear();
  ++stage.world.resource<SceneAssets>().version;
  EXPECT_ASSERT((void)stage.render(CarelessHost::request()), "normals");
}

TEST(WorldMisuse, a_light_or_a_mesh_without_a_transform_is_logged_once) {
  CarelessHost stage;
  const Entity light = stage.world.create(Light{});
  const Entity mesh = stage.world.create(LocalTransform{}, MeshInstance{0});
  for (int frame = 0; frame < 2; ++frame) ASSERT_TRUE(stage.render(CarelessHost::request()).ok());
  EXPECT_THAT(stage.lines, Contains(HasSubstr(text_of(light) + " has a Light but no WorldTransform")));
  EXPECT_THAT(stage.lines, Contains(HasSubstr(text_of(mesh) + " has a MeshInstance but no WorldTransform")));
  EXPECT_THAT(stage.lines, SizeIs(2));
}

TEST(WorldMisuse, an_entity_that_is_its_own_ancestor) {
  CarelessHost stage;
  const Entity a = stage.world.create(WorldTransform{}, LocalTransform{});
  const Entity b = stage.world.create(WorldTransform{}, LocalTransform{}, Parent{a, 1});
  stage.world.add(a, Parent{b, 2});
  EXPECT_ASSERT((void)stage.render(CarelessHost::request()), "the node tree has a cycle");
}

TEST(WorldMisuse, lights_of_no_sense_draw_and_are_logged) {
  CarelessHost stage;
  Light light;
  light.intensity = std::numeric_limits<float>::infinity();
  stage.world.create(WorldTransform{}, light);
  light.intensity = std::numeric_limits<float>::quiet_NaN();
  light.range_m = -3.0f;
  stage.world.create(WorldTransform{}, light);
  ASSERT_TRUE(stage.render(CarelessHost::request()).ok());
  EXPECT_THAT(stage.device->faults(), ::testing::IsEmpty());
  EXPECT_THAT(stage.lines, Contains(HasSubstr("intensity")));
}

}  // namespace
}  // namespace gloam
