// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/window/fly_camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "engine/scene/gltf/import.h"

namespace gloam {
namespace {

void expect_near(const dmat4& a, const dmat4& b) {
  for (int column = 0; column < 4; ++column) EXPECT_LT(glm::length(a[column] - b[column]), 1e-9) << "column " << column;
}

void expect_near(const dvec3& a, const dvec3& b) {
  EXPECT_LT(glm::length(a - b), 1e-9) << a.x << " " << a.y << " " << a.z;
}

dvec3 position_of(const FlyCamera& camera) { return dvec3(camera.world_from_camera()[3]); }

TEST(FlyCamera, keeps_the_pose_it_is_given) {
  for (const dvec3& target : {dvec3(1, 0, 0), dvec3(-1, 0.4, 2), dvec3(0, -0.7, 1), dvec3(0.2, 0.9, -0.1)}) {
    const dmat4 pose = glm::inverse(glm::lookAt(dvec3(0.0), target, dvec3(0, 1, 0)));
    expect_near(FlyCamera(pose).world_from_camera(), pose);
  }
}

TEST(FlyCamera, drops_roll) {
  const dmat4 level = glm::inverse(glm::lookAt(dvec3(3, 4, 5), dvec3(0, 3, 1), dvec3(0, 1, 0)));
  const dmat4 rolled = glm::rotate(level, 0.7, dvec3(0, 0, 1));
  expect_near(FlyCamera(rolled).world_from_camera(), level);
}

TEST(FlyCamera, keeps_its_heading_when_it_starts_straight_down) {
  const dmat4 down = glm::rotate(glm::rotate(dmat4(1.0), 0.8, dvec3(0, 1, 0)), -0.5 * std::acos(-1.0), dvec3(1, 0, 0));
  FlyCamera camera(down);
  camera.advance({.tilt = 0.5 * std::acos(-1.0)}, 0.0);
  const dvec3 forward = -dvec3(camera.world_from_camera()[2]);
  EXPECT_NEAR(std::atan2(-forward.x, -forward.z), 0.8, 1e-6);
}

TEST(FlyCamera, moves_along_its_own_axes) {
  FlyCamera camera;
  camera.advance({.forward = 1.0}, 1.0);
  expect_near(position_of(camera), {0, 0, -3});
  camera.advance({.right = 1.0}, 1.0);
  expect_near(position_of(camera), {3, 0, -3});
  camera.advance({.up = -1.0}, 2.0);
  expect_near(position_of(camera), {3, -6, -3});
}

TEST(FlyCamera, turns_to_the_left_and_flies_there) {
  FlyCamera camera;
  camera.advance({.forward = 1.0, .turn = 0.5 * std::acos(-1.0)}, 1.0);
  expect_near(position_of(camera), {-3, 0, 0});
}

TEST(FlyCamera, is_no_faster_diagonally) {
  FlyCamera camera;
  camera.advance({.forward = 1.0, .right = 1.0, .up = 1.0, .speed = 2.0}, 1.0);
  EXPECT_NEAR(glm::length(position_of(camera)), 6.0, 1e-9);
}

TEST(FlyCamera, never_tips_over) {
  FlyCamera camera;
  for (int i = 0; i < 100; ++i) camera.advance({.tilt = 0.3}, 0.0);
  const dmat4 pose = camera.world_from_camera();
  EXPECT_GT(pose[1].y, 0.0);
  EXPECT_LT(pose[2].y, -0.999);
}

struct Flight : ::testing::Test {
  World world;
  ViewSettings settings;
  ViewFlight flight;

  Flight() {
    prepare_scene_world(world);
    settings.camera_entity = world.create(Camera{.fov_y = 0.5f}, WorldTransform{});
  }
  void move_scene_camera(const dvec3& to) {
    world.get<WorldTransform>(settings.camera_entity).matrix = glm::translate(dmat4(1.0), to);
  }
};

TEST_F(Flight, follows_the_scenes_camera_until_the_user_moves) {
  flight.advance(world, {.speed = 5.0}, 1.0, settings);
  EXPECT_TRUE(settings.follow_camera);
  for (const FlyInput& input : {FlyInput{.forward = 1.0}, FlyInput{.right = 1.0}, FlyInput{.up = 1.0},
                                FlyInput{.turn = 0.1}, FlyInput{.tilt = 0.1}}) {
    ViewSettings own = settings;
    ViewFlight().advance(world, input, 1.0, own);
    EXPECT_FALSE(own.follow_camera);
  }
}

TEST_F(Flight, starts_where_the_scenes_camera_has_come_to_and_keeps_its_effects) {
  const Entity camera = settings.camera_entity;
  move_scene_camera({0, 5, 0});
  flight.advance(world, {.forward = 1.0}, 1.0, settings);
  expect_near(dvec3(settings.world_from_camera[3]), {0, 5, -3});
  EXPECT_EQ(settings.camera.fov_y, 0.5f);
  move_scene_camera({9, 9, 9});
  flight.advance(world, {}, 1.0, settings);
  expect_near(dvec3(settings.world_from_camera[3]), {0, 5, -3});
  EXPECT_EQ(settings.camera_entity, camera);
}

TEST_F(Flight, needs_no_camera_in_the_scene) {
  settings.camera_entity = kNoEntity;
  settings.world_from_camera = glm::translate(dmat4(1.0), dvec3(1, 2, 3));
  flight.advance(world, {.up = 1.0}, 1.0, settings);
  expect_near(dvec3(settings.world_from_camera[3]), {1, 5, 3});
}

/// Where a world position lies in the camera's axes.
dvec3 seen_from(const FlyCamera& camera, const dvec3& point) {
  return dvec3(glm::inverse(camera.world_from_camera()) * dvec4(point, 1.0));
}

TEST(FlyCamera, orbits_a_point_that_keeps_its_place_in_the_picture) {
  FlyCamera camera(glm::inverse(glm::lookAt(dvec3(3, 2, 5), dvec3(0, 1, 0), dvec3(0, 1, 0))));
  const dvec3 pivot(1, 0.5, -2);
  const dvec3 before = seen_from(camera, pivot);
  const dvec3 from = position_of(camera);
  for (int i = 0; i < 40; ++i) camera.advance({.orbit_turn = 0.3, .orbit_tilt = 0.2, .pivot = pivot}, 0.1);
  expect_near(seen_from(camera, pivot), before);
  EXPECT_GT(glm::distance(position_of(camera), from), 1.0);
  EXPECT_LT(glm::dot(dvec3(camera.world_from_camera()[2]), dvec3(0, 1, 0)), 1.0) << "the tilt stays within its limits";
}

TEST(FlyCamera, approaches_a_point_but_never_reaches_it) {
  FlyCamera camera;
  const dvec3 pivot(0, 3, -4);
  camera.advance({.approach = 0.5, .pivot = pivot}, 0.1);
  expect_near(position_of(camera), dvec3(0, 1.5, -2));
  for (int i = 0; i < 60; ++i) camera.advance({.approach = 0.5, .pivot = pivot}, 0.1);
  EXPECT_NEAR(glm::distance(position_of(camera), pivot), 0.01, 1e-9);
  camera.advance({.approach = 100.0, .pivot = pivot}, 0.1);
  EXPECT_NEAR(glm::distance(position_of(camera), pivot), 1.0, 1e-9);
}

TEST(FlyCamera, looks_at_a_point) {
  for (const dvec3& pivot : {dvec3(4, 1, 3), dvec3(-2, 5, -1), dvec3(0, -3, 0.1)}) {
    FlyCamera camera;
    camera.advance({.look_at_pivot = true, .pivot = pivot}, 0.1);
    expect_near(seen_from(camera, pivot), dvec3(0, 0, -glm::length(pivot)));
  }
  FlyCamera inside;
  inside.advance({.orbit_turn = 0.4, .approach = 0.5, .look_at_pivot = true}, 0.1);
  EXPECT_TRUE(std::isfinite(inside.world_from_camera()[3].x)) << "the pivot is the camera's position";
}

}  // namespace
}  // namespace gloam
