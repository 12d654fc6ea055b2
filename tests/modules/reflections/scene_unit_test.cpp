// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/scene_unit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/scene/gltf/import.h"
#include "engine/scene/units.h"
#include "tests/support/render_scene.h"

namespace gloam {
namespace {

/// A room, three things in it and a camera, all lengths times `scale`. Places are not read, so things lie at the
/// origin.
struct ScaledRoom {
  explicit ScaledRoom(double factor) : scale(factor) {
    prepare_scene_world(world);
    thing(8.0);
    for (int i = 0; i < 3; ++i) thing(1.5);
    Camera camera;
    camera.near_m = static_cast<float>(0.1 * factor);
    world.create(camera);
  }
  /// A square with this side, as half of it in the mesh and twice in the node's parent.
  void thing(double side) {
    const auto mesh = maker.mesh(test::quad(0.25f * static_cast<float>(side), maker.material({})));
    const Entity parent = world.create(LocalTransform{.scale = dvec3(2.0 * scale)});
    world.create(MeshInstance{.mesh = mesh}, LocalTransform{}, Parent{parent});
  }
  double scale;
  World world;
  test::SceneMaker maker{world};
};

TEST(SceneUnit, of_a_room_follows_its_scale) {
  for (const double scale : {1e-6, 0.001, 0.01, 0.1, 1.0, 10.0, 100.0, 1000.0})
    EXPECT_NEAR(estimate_scene_unit(ScaledRoom(scale).world) / scale, 1.0, 1e-9) << scale;
}

TEST(SceneUnit, does_not_follow_one_object_that_is_huge_or_tiny) {
  for (const double scale : {1.0, 100.0})
    for (const double side : {1e-5, 1e5}) {
      ScaledRoom room(scale);
      room.thing(side);
      EXPECT_NEAR(estimate_scene_unit(room.world) / scale, 1.0, 1e-9) << scale << " " << side;
    }
  ScaledRoom small(0.01);
  small.thing(1e-5);
  EXPECT_NEAR(estimate_scene_unit(small.world), 0.01, 1e-9);
}

TEST(SceneUnit, is_not_large_where_a_near_plane_is_close_or_no_camera_says_how_far_it_is) {
  ScaledRoom town(100.0);
  town.world.create(Camera{});
  EXPECT_EQ(estimate_scene_unit(town.world), 1.0);
  World without;
  prepare_scene_world(without);
  test::SceneMaker maker(without);
  without.create(MeshInstance{.mesh = maker.mesh(test::quad(400.0f, maker.material({})))});
  EXPECT_EQ(estimate_scene_unit(without), 1.0);
}

TEST(SceneUnit, is_1_without_meshes_of_any_size) {
  World empty;
  prepare_scene_world(empty);
  EXPECT_EQ(estimate_scene_unit(empty), 1.0);
  ScaledRoom flat(0.0);
  EXPECT_EQ(estimate_scene_unit(flat.world), 1.0);
}

TEST(SceneUnit, is_what_the_scene_states_before_what_is_estimated) {
  ScaledRoom room(0.01);
  EXPECT_EQ(scene_unit(room.world), 1.0) << "made by a host: in metres";
  ASSERT_TRUE(keep_estimated_unit(room.world).ok());
  EXPECT_NEAR(scene_unit(room.world), 0.01, 1e-12);
  room.world.set_resource(SceneUnits{0.5});
  EXPECT_EQ(scene_unit(room.world), 2.0);
}

}  // namespace
}  // namespace gloam
