// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "engine/ecs/view.h"
#include "sandbox/bench/ecs/case.h"

namespace gloam::bench {
namespace {

std::vector<Content> two_things() {
  return {{.index = 0, .position = {.x = 1.0f}, .velocity = {}, .has_mass = false, .mass = {}},
          {.index = 1, .position = {.x = 2.0f}, .velocity = {}, .has_mass = true, .mass = {.kg = 3.0f}}};
}

TEST(EcsContent, hash_does_not_depend_on_the_order_of_rows) {
  std::vector<Content> swapped = two_things();
  std::swap(swapped[0], swapped[1]);
  EXPECT_EQ(hash_of_contents(two_things()), hash_of_contents(swapped));
}

TEST(EcsContent, hash_depends_on_every_value) {
  const std::uint64_t hash = hash_of_contents(two_things());
  const auto changed = [&](auto change) {
    std::vector<Content> contents = two_things();
    change(contents[1]);
    return hash_of_contents(contents);
  };
  EXPECT_NE(hash, changed([](Content& c) { c.index = 2; }));
  EXPECT_NE(hash, changed([](Content& c) { c.position.z = 9.0f; }));
  EXPECT_NE(hash, changed([](Content& c) { c.velocity.y = 9.0f; }));
  EXPECT_NE(hash, changed([](Content& c) { c.mass.kg = 9.0f; }));
  EXPECT_NE(hash, changed([](Content& c) { c.has_mass = false; }));
}

TEST(EcsContent, a_world_and_a_bare_table_with_equal_contents_have_equal_hashes_also_after_changes) {
  World world;
  register_components(world);
  BareTable table;
  std::vector<Entity> entities;
  for (std::size_t i = 0; i < 100; ++i) {
    entities.push_back(world.create(start_of(i), Velocity{}));
    table.create(start_of(i), Velocity{});
  }
  const std::uint64_t before = content_hash(world);
  EXPECT_EQ(before, content_hash(table));
  for (const std::uint32_t i : {7u, 3u, 99u}) {
    world.add<Mass>(entities[i], Mass{});
    table.add_mass(i, Mass{});
  }
  EXPECT_NE(content_hash(world), before) << "a component was added";
  EXPECT_EQ(content_hash(world), content_hash(table));
  world.remove<Mass>(entities[3]);
  EXPECT_NE(content_hash(world), content_hash(table));
  table.remove_mass(3);
  EXPECT_EQ(content_hash(world), content_hash(table));
}

TEST(EcsContent, the_unchecked_look_up_finds_what_the_checked_one_finds) {
  BareTable table;
  for (std::size_t i = 0; i < 10; ++i) table.create(start_of(i), Velocity{});
  table.add_mass(4, Mass{});
  for (std::uint32_t i = 0; i < 10; ++i) EXPECT_EQ(&table.position({i}), &table.unchecked_position({i}));
}

}  // namespace
}  // namespace gloam::bench
