// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <random>
#include <vector>

#include "engine/scene/gltf/import.h"
#include "engine/scene/systems.h"
#include "tests/scene/forest.h"

namespace gloam {
namespace {

class TransformSystem : public testing::Test {
 protected:
  TransformSystem() {
    prepare_scene_world(world_);
    schedule_.set_checked(true);
    schedule_.add_system("transforms", "engine", Stage::world, &transform_system);
  }

  void run() { schedule_.run(Stage::world, world_, *executor_); }
  [[nodiscard]] dvec3 position(Entity entity) { return dvec3(world_.get<WorldTransform>(entity).matrix[3]); }
  Entity node(const dvec3& at) { return world_.create(LocalTransform{.translation = at}, WorldTransform{}); }

  World world_;
  Schedule schedule_;
  std::unique_ptr<JobExecutor> executor_ = make_serial_executor();
};

TEST_F(TransformSystem, random_forests_in_many_archetypes_equal_the_recursive_product) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const test::Forest forest = test::random_forest(seed, 300);
    World world;
    prepare_scene_world(world);
    std::vector<Entity> entities;
    for (std::uint32_t row = 0; row < forest.parents.size(); ++row) {
      const Entity entity = world.create(WorldTransform{});
      if (row % 3 == 0) world.add(entity, LocalMatrix{forest.locals[row]});
      // Entities with a matrix must ignore the pose.
      world.add(entity, row % 6 == 0 ? LocalTransform{.translation = dvec3(1e9)} : forest.poses[row]);
      if (row % 5 == 0) world.add(entity, MeshInstance{});
      entities.push_back(entity);
    }
    for (std::uint32_t row = 0; row < forest.parents.size(); ++row) {
      if (forest.parents[row] != kNoParentRow)
        world.add(entities[row], Parent{entities[forest.parents[row]], forest.depths[row]});
    }
    schedule_.run(Stage::world, world, *executor_);
    for (std::uint32_t row = 0; row < forest.parents.size(); ++row) {
      const dmat4& found = world.get<WorldTransform>(entities[row]).matrix;
      EXPECT_LT(test::relative_difference(found, test::world_by_recursion(forest, row)), 1e-12) << seed << " " << row;
    }
  }
}

TEST_F(TransformSystem, children_may_be_made_before_their_parents) {
  const Entity child = node(dvec3(1.0, 0.0, 0.0));
  const Entity parent = node(dvec3(0.0, 10.0, 0.0));
  world_.add(child, Parent{parent, 1});
  run();
  EXPECT_EQ(position(child), dvec3(1.0, 10.0, 0.0));
}

TEST_F(TransformSystem, reparenting_without_new_depths_is_still_right) {
  const Entity a = node(dvec3(1.0, 0.0, 0.0));
  const Entity b = node(dvec3(0.0, 1.0, 0.0));
  const Entity c = node(dvec3(0.0, 0.0, 1.0));
  world_.add(b, Parent{a, 1});
  world_.add(c, Parent{b, 2});
  run();
  EXPECT_EQ(position(c), dvec3(1.0, 1.0, 1.0));
  const Entity top = node(dvec3(100.0, 0.0, 0.0));
  world_.add(a, Parent{top, 1});  // now the depths of b and c are too small by one
  run();
  EXPECT_EQ(position(c), dvec3(101.0, 1.0, 1.0));
  world_.get<Parent>(c) = Parent{top, 2};
  run();
  EXPECT_EQ(position(c), dvec3(100.0, 0.0, 1.0));
}

TEST_F(TransformSystem, a_child_of_a_dead_parent_is_a_root) {
  const Entity parent = node(dvec3(5.0, 0.0, 0.0));
  const Entity child = node(dvec3(1.0, 0.0, 0.0));
  const Entity grandchild = node(dvec3(1.0, 0.0, 0.0));
  world_.add(child, Parent{parent, 1});
  world_.add(grandchild, Parent{child, 2});
  run();
  EXPECT_EQ(position(grandchild), dvec3(7.0, 0.0, 0.0));
  world_.destroy(parent);
  const Entity same_slot = node(dvec3(50.0, 0.0, 0.0));
  EXPECT_EQ(same_slot.index, parent.index);
  run();
  EXPECT_EQ(position(child), dvec3(1.0, 0.0, 0.0));
  EXPECT_EQ(position(grandchild), dvec3(2.0, 0.0, 0.0));
}

TEST_F(TransformSystem, a_root_without_a_pose_belongs_to_the_host) {
  dmat4 placed(1.0);
  placed[3] = dvec4(3.0, 4.0, 5.0, 1.0);
  const Entity host = world_.create(WorldTransform{placed});
  const Entity child = node(dvec3(1.0, 0.0, 0.0));
  world_.add(child, Parent{host, 1});
  run();
  run();
  EXPECT_EQ(position(host), dvec3(3.0, 4.0, 5.0));
  EXPECT_EQ(position(child), dvec3(4.0, 4.0, 5.0));
}

TEST_F(TransformSystem, a_child_without_a_pose_follows_its_parent_every_frame) {
  const Entity parent = node(dvec3(5.0, 0.0, 0.0));
  const Entity child = world_.create(WorldTransform{}, Parent{parent, 1});
  run();
  world_.get<LocalTransform>(parent).translation = dvec3(6.0, 0.0, 0.0);
  run();
  EXPECT_EQ(position(child), dvec3(6.0, 0.0, 0.0));
}

TEST_F(TransformSystem, a_micrometre_is_kept_ten_kilometres_out) {
  const Entity far = node(dvec3(10'000.0, 0.0, -10'000.0));
  const Entity near = node(dvec3(1e-6, 0.0, 0.0));
  world_.add(near, Parent{far, 1});
  run();
  EXPECT_NEAR(position(near).x - position(far).x, 1e-6, 1e-11);
}

TEST_F(TransformSystem, changes_of_any_kind_between_frames_equal_the_recursive_product) {
  std::mt19937 random(3);
  test::Forest forest = test::random_forest(3, 400);
  std::vector<Entity> entities;
  for (std::uint32_t row = 0; row < forest.parents.size(); ++row) {
    entities.push_back(world_.create(WorldTransform{}));
    if (row % 3 == 0) {
      world_.add(entities[row], LocalMatrix{forest.locals[row]});
    } else {
      world_.add(entities[row], forest.poses[row]);
    }
    if (row % 5 == 0) world_.add(entities[row], MeshInstance{});
  }
  for (std::uint32_t row = 0; row < forest.parents.size(); ++row)
    if (forest.parents[row] != kNoParentRow)
      world_.add(entities[row], Parent{entities[forest.parents[row]], forest.depths[row]});
  for (int frame = 0; frame < 60; ++frame) {
    // Half of the frames change nothing, the others a few nodes: poses, kinds of poses, parents, world matrices.
    for (std::uint32_t change = 0; frame % 2 == 1 && change < random() % 4; ++change) {
      const auto row = static_cast<std::uint32_t>(random() % 400);
      switch (random() % 4) {
        case 0:
          forest.poses[row] = test::random_pose(random);
          forest.locals[row] = local_matrix(forest.poses[row]);
          if (auto* matrix = world_.try_get<LocalMatrix>(entities[row])) {
            matrix->matrix = forest.locals[row];
          } else {
            world_.get<LocalTransform>(entities[row]) = forest.poses[row];
          }
          break;
        case 1:
          if (!world_.remove<LocalMatrix>(entities[row])) {
            world_.add(entities[row], LocalMatrix{forest.locals[row]});
          } else {
            world_.add(entities[row], forest.poses[row]);
          }
          break;
        case 2:
          forest.parents[row] = kNoParentRow;
          static_cast<void>(world_.remove<Parent>(entities[row]));
          break;
        case 3:
          world_.add(entities[row], WorldTransform{});  // marks it as changed
          break;
      }
    }
    run();
    for (std::uint32_t row = 0; row < forest.parents.size(); ++row) {
      const dmat4& found = world_.get<WorldTransform>(entities[row]).matrix;
      ASSERT_LT(test::relative_difference(found, test::world_by_recursion(forest, row)), 1e-12) << frame << " " << row;
    }
  }
}

TEST_F(TransformSystem, what_rests_is_not_composed_again) {
  const Entity parent = node(dvec3(1.0, 0.0, 0.0));
  const Entity child = node(dvec3(0.0, 1.0, 0.0));
  const Entity resting = node(dvec3(0.0, 0.0, 1.0));
  world_.add(child, Parent{parent, 1});
  run();
  // A matrix that is written without a mark stays until the node is composed.
  for (const Entity entity : {parent, child, resting}) world_.get<WorldTransform>(entity).matrix[3].x = 77.0;
  run();
  for (const Entity entity : {parent, child, resting}) EXPECT_EQ(position(entity).x, 77.0);
  world_.get<LocalTransform>(parent).translation.x = 2.0;
  run();
  EXPECT_EQ(position(parent), dvec3(2.0, 0.0, 0.0));
  EXPECT_EQ(position(child), dvec3(2.0, 1.0, 0.0));
  EXPECT_EQ(position(resting).x, 77.0);
  world_.mark_changed<WorldTransform>(resting);
  run();
  EXPECT_EQ(position(resting), dvec3(0.0, 0.0, 1.0));
}

TEST_F(TransformSystem, a_pose_that_is_not_a_number_is_no_change) {
  const Entity bad = node(dvec3(std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0));
  run();
  const auto view = world_.view<const WorldTransform>();
  const Tick seen = view.changed_since<const WorldTransform>(0, [](std::span<const WorldTransform>) {});
  run();
  std::size_t changed = 0;
  static_cast<void>(
      view.changed_since<const WorldTransform>(seen, [&](std::span<const WorldTransform> c) { changed += c.size(); }));
  EXPECT_EQ(changed, 0u);
  world_.get<LocalTransform>(bad).translation.x = 3.0;
  run();
  EXPECT_EQ(position(bad), dvec3(3.0, 0.0, 0.0));
}

TEST_F(TransformSystem, only_what_moved_is_marked_as_changed) {
  std::vector<Entity> still(5000);
  world_.create_bulk(std::span(still), LocalTransform{}, WorldTransform{});
  const Entity moving = world_.create(LocalTransform{}, WorldTransform{}, SourceNode{0});
  run();
  const auto view = world_.view<const WorldTransform>();
  const Tick seen = view.changed_since<const WorldTransform>(0, [](std::span<const WorldTransform>) {});
  run();
  std::size_t changed = 0;
  const auto count = [&](std::span<const WorldTransform> range) { changed += range.size(); };
  const Tick quiet = view.changed_since<const WorldTransform>(seen, count);
  EXPECT_EQ(changed, 0u);
  world_.get<LocalTransform>(moving).translation.x = 1.0;
  run();
  static_cast<void>(view.changed_since<const WorldTransform>(quiet, count));
  EXPECT_EQ(changed, 1u);
}

}  // namespace
}  // namespace gloam
