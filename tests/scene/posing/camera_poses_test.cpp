// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/posing/camera_poses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <memory>

#include "engine/scene/gltf/import.h"
#include "engine/scene/systems.h"

namespace gloam {
namespace {

const dmat4 kTurn = glm::translate(dmat4(1.0), dvec3(1.0, -2.0, 3.0)) *
                    glm::rotate(dmat4(1.0), 1.1, glm::normalize(dvec3(1.0, 2.0, 3.0)));

void expect_near(const dmat4& found, const dmat4& expected, const dvec3& scale) {
  for (int column = 0; column < 4; ++column)
    EXPECT_LT(glm::length(found[column] - expected[column]), 1e-9)
        << column << ": scale " << scale.x << " " << scale.y << " " << scale.z;
}

TEST(RigidPose, is_that_of_the_node_without_its_scale) {
  for (const dvec3 scale : {dvec3(1.0), dvec3(3.0, 0.1, 7.0), dvec3(1e-250), dvec3(1e250), dvec3(1e-38, 1e38, 1.0),
                            dvec3(-1.0, 1.0, 1.0)}) {
    const auto pose = rigid_pose(kTurn * glm::scale(dmat4(1.0), scale));
    ASSERT_TRUE(pose);
    expect_near(*pose, kTurn, scale);
  }
}

TEST(RigidPose, of_a_node_that_is_flat_along_one_axis_follows_from_the_other_two) {
  for (int axis = 0; axis < 3; ++axis) {
    dvec3 scale(2.0, 3.0, 4.0);
    scale[axis] = 0.0;
    const auto pose = rigid_pose(kTurn * glm::scale(dmat4(1.0), scale));
    ASSERT_TRUE(pose) << axis;
    expect_near(*pose, kTurn, scale);
  }
}

TEST(RigidPose, is_missing_if_fewer_than_two_directions_are_left) {
  for (const dvec3 scale : {dvec3(0.0), dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0), dvec3(0.0, 0.0, 1.0)})
    EXPECT_FALSE(rigid_pose(kTurn * glm::scale(dmat4(1.0), scale)));
  dmat4 parallel(1.0);
  for (int column = 0; column < 3; ++column) parallel[column] = dvec4(dvec3(0.1f, 0.2f, 0.3f) * (column - 1.5), 0.0);
  EXPECT_FALSE(rigid_pose(parallel));
  for (const double fault : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    dmat4 matrix(1.0);
    matrix[3].y = fault;
    EXPECT_FALSE(rigid_pose(matrix));
    matrix = dmat4(fault);
    EXPECT_FALSE(rigid_pose(matrix));
  }
}

TEST(CameraPoses, keep_the_last_rigid_pose_of_each_camera_that_lives) {
  World world;
  prepare_scene_world(world);
  Schedule schedule;
  schedule.set_checked(true);
  add_scene_systems(schedule);
  const auto executor = make_serial_executor();
  const auto run = [&] { schedule.run(Stage::world, world, *executor); };
  const Entity first = world.create(LocalTransform{.translation = dvec3(1.0)}, WorldTransform{}, Camera{});
  const Entity second = world.create(LocalTransform{.scale = dvec3(0.0)}, WorldTransform{}, Camera{});
  run();
  const auto pose_of = [&](Entity camera) { return world.resource<CameraPoses>().find(camera); };
  ASSERT_NE(pose_of(first), nullptr);
  EXPECT_EQ(dvec3((*pose_of(first))[3]), dvec3(1.0));
  EXPECT_EQ(pose_of(second), nullptr);
  world.get<LocalTransform>(first) = {.translation = dvec3(5.0), .scale = dvec3(0.0)};
  run();
  ASSERT_NE(pose_of(first), nullptr);
  EXPECT_EQ(dvec3((*pose_of(first))[3]), dvec3(1.0)) << "the last pose, with its position";
  world.destroy(first);
  run();
  EXPECT_TRUE(world.resource<CameraPoses>().rows.empty());
}

}  // namespace
}  // namespace gloam
