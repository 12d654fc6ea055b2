// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/worlds/world_slots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <set>

#include "engine/gpu/recording/device.h"
#include "engine/scene/gltf/import.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// What a renderer gives its WorldSlots.
struct SlotOwner {
  std::unique_ptr<gpu::RecordingDevice> device = gpu::make_recording_device();
  Pipelines pipelines{*device};
  WorldSlots slots{*device, pipelines, {}};
};

TEST(WorldSlots, numbers_differ_and_begin_at_one) {
  SlotOwner owner;
  std::set<std::uint64_t> seen;
  World worlds[3];
  for (World& world : worlds) {
    owner.slots.add(world);
    EXPECT_GE(world_id(world), 1u);
    EXPECT_TRUE(seen.insert(world_id(world)).second);
  }
  owner.slots.add(worlds[1]);  // prepared again
  EXPECT_TRUE(seen.insert(world_id(worlds[1])).second);
}

TEST(WorldSlots, a_world_that_was_never_prepared_has_no_number) {
  const World world;
  EXPECT_ASSERT((void)world_id(world), "a world must be prepared by the renderer that draws it");
  const SlotOwner owner;
  EXPECT_ASSERT((void)owner.slots.slot_of(world), "a world must be prepared");
  EXPECT_FALSE(owner.slots.has(world));
}

TEST(WorldSlots, a_world_of_another_renderer_is_refused_while_that_one_lives) {
  SlotOwner first, second;
  World world;
  first.slots.add(world);
  second.slots.take_over(world);
  EXPECT_TRUE(first.slots.has(world));
  EXPECT_FALSE(second.slots.has(world));
  EXPECT_ASSERT((void)second.slots.slot_of(world), "was prepared by another renderer");
}

TEST(WorldSlots, a_world_that_is_taken_over_gets_a_number_that_no_world_of_the_new_renderer_has) {
  auto first = std::make_unique<SlotOwner>();
  World old;
  first->slots.add(old);
  old.resource<WorldSlot>().frames = 7;
  const std::uint64_t number = world_id(old);
  first.reset();
  SlotOwner second;
  World own;
  second.slots.add(own);
  ASSERT_EQ(world_id(own), number) << "both renderers begin with the same number, or this test shows nothing";
  second.slots.take_over(old);
  EXPECT_NE(world_id(old), world_id(own));
  EXPECT_EQ(second.slots.slot_of(old).frames, 7u) << "the count of frames goes on";
}

TEST(WorldSlots, destroyed_worlds_are_lost_until_they_are_removed) {
  SlotOwner owner;
  auto first = std::make_unique<World>();
  auto second = std::make_unique<World>();
  owner.slots.add(*first);
  owner.slots.add(*second);
  const std::uint64_t lost = world_id(*first);
  EXPECT_THAT(owner.slots.lost(), IsEmpty());
  first.reset();
  EXPECT_THAT(owner.slots.lost(), ElementsAre(lost));
  owner.slots.release(lost);
  EXPECT_THAT(owner.slots.lost(), ElementsAre(lost)) << "released, but still known";
  owner.slots.remove(lost);
  EXPECT_THAT(owner.slots.lost(), IsEmpty());
}

TEST(WorldSlots, a_world_that_is_released_gets_new_assets) {
  SlotOwner owner;
  World world;
  prepare_scene_world(world);
  owner.slots.add(world);
  const std::uint64_t id = world_id(world);
  EXPECT_FALSE(owner.slots.has_scene(id));
  GpuScene* scene = &owner.slots.scene_of(world);
  EXPECT_EQ(&owner.slots.scene_of(world), scene);
  EXPECT_TRUE(owner.slots.has_scene(id));
  owner.slots.release(id);
  EXPECT_FALSE(owner.slots.has_scene(id));
  (void)owner.slots.scene_of(world);
  EXPECT_TRUE(owner.slots.has_scene(id));
}

TEST(WorldSlots, an_absent_mesh_is_found_once_per_change) {
  SlotOwner owner;
  World world;
  prepare_scene_world(world);
  owner.slots.add(world);
  const Entity entity = world.create(MeshInstance{.mesh = 3});
  const std::optional<Oversight> found = owner.slots.find_absent_mesh(world);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->entity, entity);
  EXPECT_THAT(found->fault, HasSubstr("mesh 3, and SceneAssets has 0 meshes"));
  EXPECT_FALSE(owner.slots.find_absent_mesh(world).has_value()) << "nothing has changed since";
}

}  // namespace
}  // namespace gloam
