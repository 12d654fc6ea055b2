// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/field/entities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "modules/grass/growth/blade_rows.h"
#include "tests/jobs/executors.h"
#include "tests/modules/grass/growth/lawns.h"

namespace gloam {
namespace {

struct BladeWorld {
  World world;
  GrassField field;
  GrassBladeRows rows;
  std::unique_ptr<JobExecutor> jobs = make_pool_executor(2);
  Mesh mesh = test::lawn(1, 100.0f);

  explicit BladeWorld(std::uint32_t count) {
    register_grass_components(world);
    grow(count);
  }
  void grow(std::uint32_t count) {
    GrassSource source;
    source.surface.density = static_cast<float>(count) / 10000.0f;
    source.mesh = &mesh;
    grow_grass(std::span(&source, 1), {}, *jobs, field);
    make_blade_entities(world, field);
  }
  bool pack() { return pack_changed_rows(world, field, *jobs, rows); }

  [[nodiscard]] const std::vector<Entity>& blades() const { return world.resource<GrassEntities>().blades; }
  /// Packs every blade of the world into empty rows, one by one.
  [[nodiscard]] bool rows_are_right() const {
    std::vector<shaders::GrassBladeRow> expected(field.blades.size());
    world.view<const GrassBlade>().each([&](const GrassBlade& blade) {
      expected[blade.slot] = pack_blade_row(blade, field.patches[blade.slot / 256]);
    });
    return expected.size() == rows.rows.size() &&
           std::memcmp(expected.data(), rows.rows.data(), expected.size() * sizeof(expected[0])) == 0;
  }
};

TEST(BladeEntities, a_hundred_thousand_blades_are_entities_with_unique_slots_and_masters_first) {
  const BladeWorld w(100000);
  ASSERT_EQ(w.field.statistics.blades, 100000u);
  const auto masters = w.world.view<const GrassBlade, With<GrassMasterTag>>();
  const auto slaves = w.world.view<const GrassBlade, With<GrassSlaveTag>>();
  EXPECT_EQ(masters.size(), w.field.statistics.masters);
  EXPECT_EQ(masters.size() + slaves.size(), 100000u);
  EXPECT_EQ(w.world.view<const GrassPatch>().size(), w.field.patches.size());
  EXPECT_EQ(w.world.entity_count(), 100000u + w.field.patches.size());

  std::vector<std::uint32_t> slots;
  masters.each([&](const GrassBlade& blade) {
    slots.push_back(blade.slot);
    EXPECT_LT(blade.slot % 256, w.field.patches[blade.slot / 256].masters);
    EXPECT_EQ(blade.master, blade.slot);
  });
  slaves.each([&](const GrassBlade& blade) {
    slots.push_back(blade.slot);
    EXPECT_GE(blade.slot % 256, w.field.patches[blade.slot / 256].masters);
    EXPECT_LT(blade.slot % 256, w.field.patches[blade.slot / 256].blades);
  });
  std::ranges::sort(slots);
  EXPECT_EQ(std::ranges::adjacent_find(slots), slots.end());
  for (const Entity entity : w.blades()) {
    const GrassBlade& blade = w.world.get<GrassBlade>(entity);
    ASSERT_EQ(blade.root_m, w.field.blades[blade.slot].root_m);
  }
}

TEST(BladeEntities, regrowth_leaves_no_old_entity_not_even_after_a_host_destroyed_some) {
  BladeWorld w(5000);
  const std::vector<Entity> old = w.blades();
  const Entity patch = w.world.resource<GrassEntities>().patches[3];
  for (std::size_t i = 0; i < old.size(); i += 7) w.world.destroy(old[i]);
  w.world.destroy(patch);
  const Entity foreign = w.world.create(GrassSlaveTag{});
  w.grow(3000);
  for (const Entity entity : old) EXPECT_FALSE(w.world.alive(entity));
  EXPECT_TRUE(w.world.alive(foreign));
  EXPECT_EQ(w.world.entity_count(), 3000u + w.field.patches.size() + 1u);
  w.grow(0);
  EXPECT_EQ(w.world.entity_count(), 1u);
  EXPECT_EQ(w.world.resource<GrassEntities>().field_version, w.field.version);
}

TEST(BladeEntities, small_counts_become_entities) {
  for (const std::uint32_t count : {1u, 3u, 4u, 5u, 257u}) {
    BladeWorld w(count);
    EXPECT_EQ(w.world.view<const GrassBlade>().size(), count);
    EXPECT_TRUE(w.pack());
    EXPECT_TRUE(w.rows_are_right());
  }
}

TEST(BladeEntities, rows_are_packed_once_and_then_only_when_blades_change) {
  BladeWorld w(20000);
  EXPECT_TRUE(w.pack());
  EXPECT_TRUE(w.rows_are_right());
  const std::uint64_t version = w.rows.version;
  EXPECT_FALSE(w.pack());
  EXPECT_EQ(w.rows.version, version);

  const Entity blade = w.blades()[12345];
  w.world.get<GrassBlade>(blade).yaw = 1.0f;
  w.world.get<GrassBlade>(blade).length_m = 2.0f;
  EXPECT_FALSE(w.pack());  // not marked
  w.world.mark_changed<GrassBlade>(blade);
  EXPECT_TRUE(w.pack());
  EXPECT_TRUE(w.rows_are_right());
  EXPECT_NE(w.rows.version, version);
  EXPECT_FALSE(w.pack());
}

TEST(BladeEntities, a_destroyed_blade_becomes_a_row_without_length) {
  BladeWorld w(3000);
  EXPECT_TRUE(w.pack());
  for (const std::size_t place : {std::size_t{0}, std::size_t{1500}, w.blades().size() - 1}) {
    const std::uint32_t slot = w.world.get<GrassBlade>(w.blades()[place]).slot;
    w.world.destroy(w.blades()[place]);
    EXPECT_TRUE(w.pack());
    EXPECT_EQ(w.rows.rows[slot].size, 0u);
    EXPECT_TRUE(w.rows_are_right());
  }
}

TEST(BladeEntities, a_blade_that_replaces_a_destroyed_one_is_packed_and_the_old_row_is_cleared) {
  BladeWorld w(3000);
  EXPECT_TRUE(w.pack());
  // The last row of its archetype: no other row moves when it is destroyed.
  const GrassBlade old = w.world.get<GrassBlade>(w.blades().back());
  w.world.destroy(w.blades().back());
  GrassBlade added = old;
  added.slot = old.slot + 1;
  ASSERT_EQ(w.field.blades[added.slot].length_m, 0.0f);
  w.world.create(added, GrassSlaveTag{});
  EXPECT_TRUE(w.pack());
  EXPECT_EQ(w.rows.rows[old.slot].size, 0u);
  EXPECT_NE(w.rows.rows[added.slot].size, 0u);
  EXPECT_TRUE(w.rows_are_right());
}

TEST(BladeEntities, structural_changes_of_other_entities_pack_nothing) {
  BladeWorld w(3000);
  EXPECT_TRUE(w.pack());
  w.world.create(GrassPatch{});
  EXPECT_FALSE(w.pack());
  EXPECT_TRUE(w.rows_are_right());
}

TEST(BladeEntities, a_blade_with_a_slot_outside_the_field_is_left_out) {
  BladeWorld w(300);
  GrassBlade stray;
  stray.slot = 1u << 31;
  w.world.create(stray, GrassMasterTag{});
  EXPECT_TRUE(w.pack());
  EXPECT_EQ(w.rows.rows.size(), 512u);
}

TEST(BladeEntities, regrowth_repacks_all_rows) {
  BladeWorld w(3000);
  EXPECT_TRUE(w.pack());
  w.grow(1000);
  EXPECT_TRUE(w.pack());
  EXPECT_TRUE(w.rows_are_right());
  w.grow(0);
  EXPECT_TRUE(w.pack());
  EXPECT_TRUE(w.rows.rows.empty());
}

}  // namespace
}  // namespace gloam
