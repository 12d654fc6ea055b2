// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/posing/animated_nodes.h"

#include <gtest/gtest.h>

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/gltf/import.h"
#include "engine/scene/posing/animation.h"

namespace gloam {
namespace {

TEST(AnimatedNodes, are_those_with_a_channel_and_their_descendants) {
  World world;
  prepare_scene_world(world);
  const Entity root = world.create(WorldTransform{}), arm = world.create(WorldTransform{}, Parent{root, 1}),
               hand = world.create(WorldTransform{}, Parent{arm, 2}),
               beside = world.create(WorldTransform{}, Parent{root, 1});
  EXPECT_FALSE(AnimatedNodes(world).moves(hand));
  world.resource<AnimationBindings>().poses = {{arm, 0, 0}};
  const AnimatedNodes animated(world);
  EXPECT_FALSE(animated.moves(root));
  EXPECT_TRUE(animated.moves(arm));
  EXPECT_TRUE(animated.moves(hand));
  EXPECT_FALSE(animated.moves(beside));
  EXPECT_TRUE(animated.has_channel(arm));
  EXPECT_FALSE(animated.has_channel(hand));
}

TEST(AnimatedNodes, do_not_move_with_a_destroyed_parent) {
  World world;
  prepare_scene_world(world);
  const Entity root = world.create(WorldTransform{}), child = world.create(WorldTransform{}, Parent{root, 1});
  world.destroy(root);
  const Entity other = world.create(WorldTransform{});
  ASSERT_EQ(other.index, root.index);
  world.resource<AnimationBindings>().poses = {{other, 0, 0}};
  EXPECT_TRUE(AnimatedNodes(world).moves(other));
  EXPECT_FALSE(AnimatedNodes(world).moves(child));
}

}  // namespace
}  // namespace gloam
