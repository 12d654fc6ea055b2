// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/systems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "engine/core/hash.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/posing/morphing.h"
#include "tests/scene/forest.h"

namespace gloam {
namespace {

constexpr std::uint32_t kJoints = 12;

/// A chain of joints that bends, skinned instances in scattered order, and one mesh with two morph targets.
void fill_scene(World& world) {
  prepare_scene_world(world);
  SceneAssets& assets = world.resource<SceneAssets>();
  assets.meshes.resize(2);
  assets.meshes[1].primitives.resize(1);
  assets.meshes[1].primitives[0].morph_targets.resize(2);
  assets.meshes[1].morph_weights = {0.25f, 0.75f};
  assets.skins.resize(2);
  assets.clips.resize(1);
  assets.clips[0].duration_s = 2.0f;
  std::mt19937 random(5);
  Entity parent = kNoEntity;
  for (std::uint32_t joint = 0; joint < kJoints; ++joint) {
    const LocalTransform pose = test::random_pose(random);
    const Entity entity = world.create(pose, WorldTransform{}, SourceNode{joint});
    if (joint > 0) world.add(entity, Parent{parent, joint});
    parent = entity;
    for (Skin& skin : assets.skins) {
      skin.joint_nodes.push_back(joint);
      skin.inverse_bind.push_back(mat4(local_matrix(test::random_pose(random))));
    }
    assets.clips[0].channels.push_back({.node = joint,
                                        .path = AnimationPath::rotation,
                                        .interpolation = Interpolation::linear,
                                        .width = 4,
                                        .times = {0.0f, 2.0f},
                                        .values = {0, 0, 0, 1, 0, 1, 0, 0}});
  }
  assets.skins[1].joint_nodes.clear();
  assets.skins[1].inverse_bind.clear();
  for (std::uint32_t i = 0; i < 9; ++i)
    world.create(WorldTransform{}, test::random_pose(random), MeshInstance{.mesh = 0, .skin = i % 3 == 2 ? ~0u : 0u});
  const Entity morphing =
      world.create(WorldTransform{}, LocalTransform{}, MeshInstance{.mesh = 1}, MorphInstance{}, SourceNode{kJoints});
  assets.clips[0].channels.push_back({.node = kJoints,
                                      .path = AnimationPath::weights,
                                      .interpolation = Interpolation::linear,
                                      .width = 2,
                                      .times = {0.0f, 2.0f},
                                      .values = {0.0f, 1.0f, 1.0f, 0.0f}});
  static_cast<void>(morphing);
}

void run(World& world, JobExecutor& executor, double time_s) {
  Schedule schedule;
  add_scene_systems(schedule);
  schedule.set_checked(true);
  world.resource<SceneClock>().time_s = time_s;
  schedule.run(Stage::world, world, executor);
}

std::uint64_t hash_of(World& world) {
  Hasher hasher;
  world.view<const WorldTransform>().each([&](Entity entity, const WorldTransform& transform) {
    hasher.value(entity.index);
    hasher.bytes_of(transform.matrix);
  });
  for (const mat4& matrix : world.resource<JointMatrices>().matrices) hasher.bytes_of(matrix);
  for (const auto& range : world.resource<JointMatrices>().ranges) {
    hasher.value(range.instance.index).value(range.first).value(range.count).value(range.mirrored);
    hasher.bytes_of(range.origin);
  }
  for (const float weight : world.resource<MorphWeights>().values) hasher.bytes_of(weight);
  return hasher.digest();
}

TEST(SceneSystems, results_are_equal_for_every_executor) {
  std::vector<std::unique_ptr<JobExecutor>> executors;
  executors.push_back(make_serial_executor());
  for (const std::uint64_t seed : {1u, 2u, 3u}) executors.push_back(make_shuffled_executor(seed));
  for (const std::uint32_t threads : {1u, 2u, 8u}) executors.push_back(make_pool_executor(threads));
  std::uint64_t expected = 0;
  for (const auto& executor : executors) {
    World world;
    fill_scene(world);
    for (const double time : {0.0, 0.3, 1.7, 2.9}) run(world, *executor, time);
    const std::uint64_t hash = hash_of(world);
    if (expected == 0) expected = hash;
    EXPECT_EQ(hash, expected);
  }
}

TEST(SceneSystems, clips_move_poses_and_loop) {
  World world;
  fill_scene(world);
  const auto executor = make_serial_executor();
  const auto first_joint = [&] {
    dquat rotation;
    world.view<const SourceNode, const LocalTransform>().each([&](const SourceNode& node, const LocalTransform& pose) {
      if (node.index == 0) rotation = pose.rotation;
    });
    return rotation;
  };
  run(world, *executor, 1.0);
  const dquat half_way = first_joint();
  EXPECT_NEAR(half_way.w, std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(half_way.y, std::sqrt(0.5), 1e-12);
  run(world, *executor, 5.0);
  EXPECT_EQ(first_joint(), half_way);
}

TEST(SceneSystems, a_node_that_comes_later_is_animated_from_its_first_frame) {
  World world;
  fill_scene(world);
  const auto executor = make_serial_executor();
  run(world, *executor, 0.5);
  SceneAssets& assets = world.resource<SceneAssets>();
  assets.clips[0].channels.push_back({.node = kJoints + 1,
                                      .path = AnimationPath::translation,
                                      .interpolation = Interpolation::step,
                                      .width = 3,
                                      .times = {0.0f},
                                      .values = {1.0f, 2.0f, 3.0f}});
  const Entity late = world.create(LocalTransform{}, WorldTransform{}, SourceNode{kJoints + 1});
  run(world, *executor, 0.5);
  EXPECT_EQ(dvec3(world.get<WorldTransform>(late).matrix[3]), dvec3(1.0, 2.0, 3.0));
  world.destroy(late);
  run(world, *executor, 0.6);  // the node of its channel is gone
}

TEST(SceneSystems, joint_matrices_equal_the_direct_product) {
  World world;
  fill_scene(world);
  const auto executor = make_serial_executor();
  run(world, *executor, 0.7);
  std::vector<dmat4> joint_worlds(kJoints);
  world.view<const SourceNode, const WorldTransform>().each([&](const SourceNode& node, const WorldTransform& at) {
    if (node.index < kJoints) joint_worlds[node.index] = at.matrix;
  });
  const auto& joints = world.resource<JointMatrices>();
  const auto& skin = world.resource<SceneAssets>().skins[0];
  ASSERT_EQ(joints.ranges.size(), 6u);
  std::uint32_t last_index = 0;
  for (const JointMatrices::Range& range : joints.ranges) {
    EXPECT_GE(range.instance.index, last_index);
    last_index = range.instance.index;
    ASSERT_EQ(range.count, kJoints);
    EXPECT_EQ(range.origin, dvec3(joint_worlds[0][3]));
    for (std::uint32_t j = 0; j < kJoints; ++j) {
      dmat4 expected = joint_worlds[j] * dmat4(skin.inverse_bind[j]);
      expected[3] -= dvec4(range.origin, 0.0) * expected[3].w;
      EXPECT_LT(test::relative_difference(dmat4(joints.matrices[range.first + j]), expected), 1e-6);
    }
  }
}

TEST(SceneSystems, a_skin_without_joints_still_has_a_range_at_its_instance) {
  World world;
  fill_scene(world);
  const LocalTransform pose{.translation = dvec3(7.0, 8.0, 9.0)};
  const Entity instance = world.create(WorldTransform{}, pose, MeshInstance{.mesh = 0, .skin = 1});
  run(world, *make_serial_executor(), 0.0);
  const auto& ranges = world.resource<JointMatrices>().ranges;
  const auto found = std::ranges::find(ranges, instance, &JointMatrices::Range::instance);
  ASSERT_NE(found, ranges.end());
  EXPECT_EQ(found->count, 0u);
  EXPECT_EQ(found->origin, pose.translation);
}

TEST(SceneSystems, a_joint_outside_the_world_stands_where_the_instance_stands) {
  World world;
  fill_scene(world);
  SceneAssets& assets = world.resource<SceneAssets>();
  assets.skins[1].joint_nodes = {999};
  assets.skins[1].inverse_bind = {mat4(1.0f)};
  const LocalTransform pose{.translation = dvec3(7.0, 8.0, 9.0)};
  const Entity instance = world.create(WorldTransform{}, pose, MeshInstance{.mesh = 0, .skin = 1});
  run(world, *make_serial_executor(), 0.0);
  const auto& joints = world.resource<JointMatrices>();
  const auto found = std::ranges::find(joints.ranges, instance, &JointMatrices::Range::instance);
  ASSERT_NE(found, joints.ranges.end());
  EXPECT_EQ(found->origin, pose.translation);
  EXPECT_EQ(joints.matrices[found->first], mat4(1.0f));
}

TEST(SceneSystems, morph_weights_begin_with_the_defaults_and_follow_the_clip) {
  World world;
  fill_scene(world);
  const auto executor = make_serial_executor();
  run(world, *executor, 0.5);
  EXPECT_EQ(world.resource<MorphWeights>().values,
            (std::vector{0.25f, 0.75f}));  // the clip has the same values at this time
  run(world, *executor, 1.5);
  EXPECT_EQ(world.resource<MorphWeights>().values, (std::vector{0.75f, 0.25f}));
  const Entity second = world.create(MeshInstance{.mesh = 1}, MorphInstance{});
  run(world, *executor, 1.0);
  EXPECT_EQ(world.resource<MorphWeights>().values, (std::vector{0.5f, 0.5f, 0.25f, 0.75f}));
  EXPECT_EQ(world.get<MorphInstance>(second).first, 2u);
}

TEST(SceneSystems, an_empty_world_gives_empty_results) {
  World world;
  prepare_scene_world(world);
  run(world, *make_serial_executor(), 3.0);
  EXPECT_TRUE(world.resource<JointMatrices>().ranges.empty());
  EXPECT_TRUE(world.resource<MorphWeights>().values.empty());
}

}  // namespace
}  // namespace gloam
