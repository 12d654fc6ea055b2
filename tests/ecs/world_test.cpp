// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/world.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "tests/ecs/components.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

struct Unregistered {
  int value = 0;
};
template <int>
struct Numbered {
  int value = 0;
};

TEST(World, an_entity_has_what_it_was_created_with) {
  TestWorld world;
  const Entity e = world.create(Position{1, 2, 3}, Health{4}, Frozen{});
  EXPECT_TRUE(world.alive(e));
  EXPECT_EQ(world.get<Health>(e).value, 4);
  EXPECT_EQ(world.get<Position>(e).z, 3);
  EXPECT_TRUE(world.has<Frozen>(e));
  EXPECT_FALSE(world.has<Serial>(e));
  EXPECT_EQ(world.try_get<Serial>(e), nullptr);
  EXPECT_NE(world.try_get<Frozen>(e), nullptr);
  EXPECT_EQ(world.entity_count(), 1u);
}

TEST(World, the_order_of_arguments_does_not_matter) {
  TestWorld world;
  world.create(Health{1}, Position{1, 1, 1});
  world.create(Position{2, 2, 2}, Health{2});
  EXPECT_EQ(world.archetypes().size(), 1u);
  EXPECT_EQ((world.view<const Health, const Position>().size()), 2u);
}

TEST(World, a_destroyed_entity_stays_dead_when_its_index_lives_again) {
  TestWorld world;
  const Entity first = world.create(Health{1});
  world.destroy(first);
  const Entity second = world.create(Health{2});
  EXPECT_EQ(first.index, second.index);
  EXPECT_FALSE(world.alive(first));
  EXPECT_TRUE(world.alive(second));
  EXPECT_EQ(world.try_get<Health>(first), nullptr);
}

TEST(World, nothing_forged_is_alive) {
  TestWorld world;
  const Entity e = world.create();
  world.destroy(e);
  EXPECT_FALSE(world.alive(kNoEntity));
  EXPECT_FALSE(world.alive({0, 0}));
  EXPECT_FALSE(world.alive({e.index, e.generation + 1})) << "the generation its slot will have next";
  EXPECT_FALSE(world.alive({77, 1}));
}

TEST(World, adding_and_removing_keeps_the_other_components) {
  TestWorld world;
  const Entity e = world.create(Health{1});
  const Entity other = world.create(Health{2});
  Position& position = world.add<Position>(e, {1, 2, 3});
  EXPECT_EQ(&position, &world.get<Position>(e));
  world.add<Frozen>(e);
  world.add<Big>(e).words[20] = 9;
  EXPECT_TRUE(world.remove<Position>(e));
  EXPECT_FALSE(world.remove<Position>(e));
  EXPECT_EQ(world.get<Health>(e).value, 1);
  EXPECT_EQ(world.get<Big>(e).words[20], 9u);
  EXPECT_TRUE(world.has<Frozen>(e));
  EXPECT_TRUE(world.remove<Frozen>(e));
  EXPECT_FALSE(world.has<Frozen>(e));
  EXPECT_EQ(world.get<Health>(other).value, 2);
}

TEST(World, adding_what_is_there_overwrites_it_in_place) {
  TestWorld world;
  const Entity e = world.create(Health{1}, Frozen{});
  const Health* before = &world.get<Health>(e);
  const std::uint64_t version = world.structure_version();
  EXPECT_EQ(&world.add<Health>(e, {5}), before);
  world.add<Frozen>(e);
  EXPECT_EQ(before->value, 5);
  EXPECT_EQ(world.structure_version(), version);
}

TEST(World, add_takes_a_value_out_of_the_row_it_moves) {
  TestWorld world;
  const Entity e = world.create(Health{1}, Serial{11});
  world.create(Health{2}, Serial{22});
  world.add(e, Position{static_cast<float>(world.get<Serial>(e).value), 0, 0});
  EXPECT_EQ(world.get<Position>(e).x, 11);
}

TEST(World, references_hold_while_columns_grow) {
  TestWorld world;
  const Entity e = world.create(Health{7}, Big{});
  Health& health = world.get<Health>(e);
  Big& big = world.get<Big>(e);
  for (int i = 0; i < 100'000; ++i) world.create(Health{i}, Big{});
  EXPECT_EQ(&health, &world.get<Health>(e));
  EXPECT_EQ(&big, &world.get<Big>(e));
  health.value = 8;
  EXPECT_EQ(world.get<Health>(e).value, 8);
}

TEST(World, bulk_creation_makes_one_range_in_order) {
  TestWorld world;
  for (int i = 0; i < 10; ++i) world.destroy(world.create());  // a free slot to reuse
  const Entity old = world.create(Health{1}, Position{});
  std::vector<Entity> made(10'000);
  world.create_bulk(made, Health{3}, Position{1, 2, 3});
  EXPECT_EQ(world.entity_count(), 10'001u);
  const Health* first = &world.get<Health>(made[0]);
  for (std::size_t i = 0; i < made.size(); ++i) {
    ASSERT_EQ(&world.get<Health>(made[i]), first + i);
    ASSERT_EQ(world.get<Health>(made[i]).value, 3);
    ASSERT_EQ(world.get<Position>(made[i]).z, 3);
  }
  EXPECT_EQ(std::set<std::uint32_t>([&] {
              std::set<std::uint32_t> indices{old.index};
              for (const Entity e : made) indices.insert(e.index);
              return indices;
            }())
                .size(),
            10'001u);
}

TEST(World, bulk_creation_of_nothing_changes_nothing) {
  TestWorld world;
  const std::uint64_t version = world.structure_version();
  world.create_bulk({}, Health{1});
  EXPECT_EQ(world.entity_count(), 0u);
  EXPECT_EQ(world.structure_version(), version);
}

TEST(World, bulk_creation_fills_free_slots_first) {
  TestWorld world({.max_rows_per_archetype = 100, .max_entities = 100});
  std::vector<Entity> made(100);
  world.create_bulk(made);
  for (int i = 0; i < 60; ++i) world.destroy(made[static_cast<std::size_t>(i)]);
  std::vector<Entity> again(60);
  world.create_bulk(again, Health{1});
  EXPECT_EQ(world.entity_count(), 100u);
  for (const Entity e : again) EXPECT_LT(e.index, 60u);
}

TEST(World, structure_version_moves_with_every_structural_change) {
  TestWorld world;
  std::uint64_t version = world.structure_version();
  const auto moved = [&] { return std::exchange(version, world.structure_version()) != version; };
  const Entity e = world.create(Health{1});
  EXPECT_TRUE(moved());
  world.add<Position>(e);
  EXPECT_TRUE(moved());
  world.get<Health>(e).value = 3;
  world.view<Health>().each([](Health& health) { ++health.value; });
  EXPECT_FALSE(moved());
  world.remove<Position>(e);
  EXPECT_TRUE(moved());
  world.destroy(e);
  EXPECT_TRUE(moved());
}

TEST(World, two_worlds_number_the_same_types_as_each_likes) {
  World a;
  World b;
  a.register_component<Health>("health");
  a.register_component<Position>("position");
  b.register_component<Position>("place");
  b.register_component<Serial>("serial");
  b.register_component<Health>("life");
  EXPECT_NE(a.component_id<Health>(), b.component_id<Health>());
  const Entity in_a = a.create(Health{1}, Position{1, 0, 0});
  const Entity in_b = b.create(Health{2}, Position{2, 0, 0});
  b.add<Serial>(in_b, {3});
  EXPECT_EQ(a.get<Health>(in_a).value, 1);
  EXPECT_EQ(b.get<Health>(in_b).value, 2);
  int sum = 0;
  a.view<const Health, const Position>().each(
      [&](const Health& h, const Position& p) { sum += h.value * 10 + static_cast<int>(p.x); });
  b.view<const Health, const Position>().each(
      [&](const Health& h, const Position& p) { sum += h.value * 1000 + static_cast<int>(p.x) * 100; });
  EXPECT_EQ(sum, 2211);
  EXPECT_FALSE(a.is_registered<Serial>());
  EXPECT_EQ(b.components()[0].name, "place");
}

TEST(World, registering_twice_changes_nothing) {
  World world;
  const ComponentId id = world.register_component<Health>("health");
  EXPECT_EQ(world.register_component<Health>("other"), id);
  EXPECT_EQ(world.components().size(), 1u);
  EXPECT_EQ(world.components()[0].name, "health");
}

TEST(World, entities_are_found_behind_components_registered_later) {
  TestWorld world;
  std::vector<Entity> entities;
  for (int i = 0; i < 1000; ++i) entities.push_back(world.create(Health{i}, Frozen{}));  // in front and rest
  const Entity dead = entities.back();
  entities.pop_back();
  world.destroy(dead);
  [&]<int... N>(std::integer_sequence<int, N...>) { (world.register_component<Numbered<N>>(), ...); }
  (std::make_integer_sequence<int, 150>{});
  EXPECT_FALSE(world.alive(dead));
  for (int i = 0; i < 999; ++i) {
    const Entity e = entities[static_cast<std::size_t>(i)];
    ASSERT_EQ(world.get<Health>(e).value, i);
    ASSERT_TRUE(world.has<Frozen>(e));
    ASSERT_EQ(world.try_get<Numbered<149>>(e), nullptr);
    ASSERT_EQ(world.add(e, Numbered<149>{-i}).value, -i);
    ASSERT_EQ(world.get<Health>(e).value, i);
  }
}

TEST(World, an_entity_that_fills_a_row_of_the_front_is_found_there) {
  TestWorld world;
  std::vector<Entity> entities;
  for (int i = 0; i < 1000; ++i) entities.push_back(world.create(Health{i}));
  for (std::size_t i = 0; i < 20; i += 2) world.destroy(entities[i]);
  for (std::size_t i = 1; i < 20; i += 2) world.add(entities[i], Frozen{});
  for (std::size_t i = 20; i < 1000; ++i) ASSERT_EQ(world.get<Health>(entities[i]).value, static_cast<int>(i));
  for (std::size_t i = 1; i < 20; i += 2) ASSERT_EQ(world.get<Health>(entities[i]).value, static_cast<int>(i));
}

TEST(World, a_thousand_small_archetypes_are_one_view) {
  World world;
  const auto add_tags = [&]<std::size_t... I>(std::index_sequence<I...>) {
    (world.register_component<std::integral_constant<std::size_t, I>>(std::to_string(I)), ...);
    world.register_component<Health>("health");
    for (std::uint32_t mask = 0; mask < 1024; ++mask) {
      const Entity e = world.create(Health{1});
      ((mask >> I & 1 ? (void)world.add<std::integral_constant<std::size_t, I>>(e) : (void)0), ...);
    }
  };
  add_tags(std::make_index_sequence<10>{});
  EXPECT_EQ(world.archetypes().size(), 1024u);
  EXPECT_EQ(world.view<const Health>().size(), 1024u);
  EXPECT_EQ((world.view<const Health, With<std::integral_constant<std::size_t, 3>>>().size()), 512u);
}

TEST(World, misuse_of_entities_asserts) {
  TestWorld world;
  const Entity dead = world.create(Health{1});
  world.destroy(dead);
  const Entity e = world.create(Health{1});
  EXPECT_ASSERT(world.destroy(dead), "not alive");
  EXPECT_ASSERT(world.destroy(kNoEntity), "not alive");
  EXPECT_ASSERT(world.add<Position>(dead), "not alive");
  EXPECT_ASSERT((void)world.remove<Health>(dead), "not alive");
  EXPECT_ASSERT((void)world.get<Health>(dead), "not alive");
  EXPECT_ASSERT((void)world.has<Health>(dead), "not alive");
  EXPECT_ASSERT(world.mark_changed<Health>(dead), "not alive");
  EXPECT_ASSERT((void)world.get<Position>(e), "has no component gloam::test::Position");
  EXPECT_ASSERT((void)world.get<Frozen>(e), "has no component gloam::test::Frozen");
  EXPECT_ASSERT(world.mark_changed<Position>(e), "has no component");
  EXPECT_EQ(world.entity_count(), 1u);
}

TEST(World, misuse_of_types_asserts) {
  TestWorld world;
  const Entity e = world.create();
  EXPECT_ASSERT(world.create(Unregistered{}), "Unregistered is not registered in this world");
  EXPECT_ASSERT(world.add<Unregistered>(e), "is not registered");
  EXPECT_ASSERT((void)world.try_get<Unregistered>(e), "is not registered");
  EXPECT_ASSERT((void)world.view<const Unregistered>(), "is not registered");
  EXPECT_ASSERT(world.register_component<Unregistered>("health"), "\"health\" is taken by another type");
  EXPECT_ASSERT(world.create(Health{1}, Health{2}), "each component once");
  EXPECT_ASSERT((void)(world.view<Health, Maybe<const Health>>()), "each column once");
}

TEST(World, limits_assert) {
  TestWorld world({.max_rows_per_archetype = 50, .max_entities = 70});
  std::vector<Entity> made(51);
  EXPECT_ASSERT(world.create_bulk(made, Health{}), "max_rows_per_archetype");
  EXPECT_EQ(world.entity_count(), 0u);
  world.create_bulk(std::span(made).first(50), Health{});
  EXPECT_ASSERT(world.create(Health{}), "max_rows_per_archetype");
  for (int i = 0; i < 20; ++i) world.create();
  EXPECT_ASSERT(world.create(), "max_entities");
  EXPECT_ASSERT(world.create_bulk(std::span(made).first(1)), "max_entities");
  world.destroy(made[0]);
  EXPECT_TRUE(world.alive(world.create()));
}

TEST(World, structural_changes_while_a_view_iterates_assert) {
  TestWorld world;
  const Entity e = world.create(Health{1}, Frozen{});
  const View<const Health> view = world.view<const Health>();
  const auto during = [&](auto&& change) { return assertion_of([&] { view.each([&](const Health&) { change(); }); }); };
  const auto asserts = ::testing::HasSubstr("structural change while a view iterates");
  std::vector<Entity> made(1);
  EXPECT_THAT(during([&] { world.create(Position{}); }), asserts);
  EXPECT_THAT(during([&] { world.create_bulk(made, Position{}); }), asserts);
  EXPECT_THAT(during([&] { world.destroy(e); }), asserts);
  EXPECT_THAT(during([&] { world.add<Position>(e); }), asserts);
  EXPECT_THAT(during([&] { world.remove<Frozen>(e); }), asserts);
  EXPECT_THAT(during([&] { world.register_component<Unregistered>("late"); }),
              ::testing::HasSubstr("no view iterates"));
  EXPECT_ASSERT(view.each_chunk([&](std::span<const Health>) { world.destroy(e); }), "while a view iterates");
  EXPECT_ASSERT((void)view.changed_since<Health>(0, [&](std::span<const Health>) { world.destroy(e); }), "iterates");
  world.destroy(e);  // allowed again afterwards
  EXPECT_EQ(world.entity_count(), 0u);
}

}  // namespace
}  // namespace gloam::test
