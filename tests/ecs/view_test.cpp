// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/view.h"

#include <gtest/gtest.h>

#include <type_traits>
#include <utility>
#include <vector>

#include "tests/ecs/components.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

TEST(View, each_visits_every_row_once) {
  TestWorld world;
  for (int i = 0; i < 100; ++i) {
    const Entity e = world.create(Health{i});
    if (i % 2 == 0) world.add<Position>(e);
    if (i % 3 == 0) world.add<Frozen>(e);
  }
  std::vector<int> visits(100);
  world.view<const Health>().each([&](const Health& health) { ++visits[static_cast<std::size_t>(health.value)]; });
  EXPECT_EQ(visits, std::vector<int>(100, 1));
}

TEST(View, each_may_take_the_entity_first) {
  TestWorld world;
  const Entity e = world.create(Health{1}, Position{});
  std::vector<Entity> seen;
  world.view<const Health, Position>().each([&](Entity entity, const Health& health, Position& position) {
    seen.push_back(entity);
    position.x = static_cast<float>(health.value);
  });
  EXPECT_EQ(seen, std::vector{e});
  EXPECT_EQ(world.get<Position>(e).x, 1);
}

TEST(View, filters_choose_archetypes) {
  TestWorld world;
  world.create(Health{1});
  const Entity frozen = world.create(Health{2}, Frozen{});
  const Entity both = world.create(Health{4}, Frozen{}, Visible{});
  const auto sum = [](const auto& view) {
    int total = 0;
    view.each([&](const Health& health) { total += health.value; });
    return total;
  };
  EXPECT_EQ(sum(world.view<const Health>()), 7);
  EXPECT_EQ(sum(world.view<const Health, With<Frozen>>()), 6);
  EXPECT_EQ(sum(world.view<With<Frozen>, const Health, Without<Visible>>()), 2);
  EXPECT_EQ(sum(world.view<const Health, Without<Frozen>>()), 1);
  EXPECT_EQ(sum(world.view<const Health, Without<Frozen>, With<Visible>>()), 0);
  std::vector<Entity> entities;
  world.view<With<Frozen>>().each([&](Entity e) { entities.push_back(e); });
  EXPECT_EQ(entities, (std::vector{frozen, both}));
}

TEST(View, maybe_hands_out_a_pointer_or_null) {
  TestWorld world;
  world.create(Health{1});
  const Entity e = world.create(Health{2}, Position{3, 0, 0});
  int with = 0;
  int without = 0;
  world.view<const Health, Maybe<Position>>().each([&](const Health& health, Position* position) {
    (position != nullptr ? with : without) += health.value;
    if (position != nullptr) position->x += 1;
  });
  EXPECT_EQ(with, 2);
  EXPECT_EQ(without, 1);
  EXPECT_EQ(world.get<Position>(e).x, 4);
  int chunks = 0;
  world.view<const Health, Maybe<const Position>>().each_chunk(
      [&](std::span<const Entity> entities, std::span<const Health> health, std::span<const Position> positions) {
        ++chunks;
        EXPECT_EQ(entities.size(), health.size());
        EXPECT_EQ(positions.size(), health[0].value == 2 ? 1u : 0u);
      });
  EXPECT_EQ(chunks, 2);
}

TEST(View, each_chunk_gives_one_contiguous_range_an_archetype) {
  TestWorld world;
  std::vector<Entity> made(5000);
  world.create_bulk(made, Health{1}, Position{});
  const Entity gone = world.create(Health{1}, Frozen{});
  world.destroy(gone);
  std::vector<std::size_t> sizes;
  world.view<Health>().each_chunk([&](std::span<const Entity> entities, std::span<Health> health) {
    sizes.push_back(health.size());
    for (std::size_t i = 0; i < entities.size(); ++i) ASSERT_EQ(&world.get<Health>(entities[i]), &health[i]);
  });
  EXPECT_EQ(sizes, std::vector<std::size_t>{5000}) << "an archetype without rows gives no range";
  std::size_t rows = 0;
  world.view<Health>().each_chunk([&](std::span<Health> health) { rows += health.size(); });
  EXPECT_EQ(rows, 5000u);
}

TEST(View, each_chunk_gives_the_front_of_an_archetype_and_its_rest) {
  TestWorld world;
  const auto view = world.view<Health, Maybe<const Position>>();
  std::vector<Entity> made;
  std::vector<const Health*> places;
  for (int i = 0; i < 1000; ++i) {
    made.push_back(world.create(Health{i}, Serial{}));
    places.push_back(&world.get<Health>(made.back()));
  }
  for (std::size_t i = 0; i < made.size(); ++i) ASSERT_EQ(&world.get<Health>(made[i]), places[i]) << "rows stay";
  std::vector<std::size_t> sizes;
  int next = 0;
  view.each_chunk([&](std::span<const Entity> entities, std::span<Health> health, std::span<const Position> none) {
    sizes.push_back(health.size());
    EXPECT_TRUE(none.empty());
    for (std::size_t i = 0; i < entities.size(); ++i, ++next) {
      ASSERT_EQ(entities[i], made[static_cast<std::size_t>(next)]);
      ASSERT_EQ(health[i].value, next);
    }
  });
  EXPECT_EQ(sizes, (std::vector<std::size_t>{kFrontRows, 1000 - kFrontRows}));
  next = 0;
  view.each([&](Entity e, Health& health, const Position* none) {
    ASSERT_EQ(e, made[static_cast<std::size_t>(next)]);
    ASSERT_EQ(health.value, next++);
    ASSERT_EQ(none, nullptr);
  });
  EXPECT_EQ(next, 1000);
}

TEST(View, many_that_come_at_once_pass_the_joint_in_order) {
  TestWorld world;
  world.create(Health{7}, Serial{});
  std::vector<Entity> made(500);
  world.create_bulk(made, Health{8}, Serial{3});
  std::size_t rows = 0;
  world.view<const Health, const Serial>().each([&](Entity e, const Health& health, const Serial& serial) {
    if (rows > 0) {
      ASSERT_EQ(e, made[rows - 1]);
      ASSERT_EQ(health.value, 8);
      ASSERT_EQ(serial.value, 3u);
    }
    ++rows;
  });
  EXPECT_EQ(rows, 501u);
}

TEST(View, sees_archetypes_that_come_later) {
  TestWorld world;
  const auto view = world.view<const Health>();
  EXPECT_TRUE(view.empty());
  world.create(Health{1});
  EXPECT_EQ(view.size(), 1u);
  world.create(Health{1}, Position{});
  world.create(Position{});
  EXPECT_EQ(view.size(), 2u);
}

TEST(View, views_may_be_nested) {
  TestWorld world;
  for (int i = 0; i < 10; ++i) world.create(Health{i}, Position{});
  int pairs = 0;
  const auto view = world.view<const Health>();
  view.each([&](const Health& a) { view.each([&](const Health& b) { pairs += a.value < b.value ? 1 : 0; }); });
  EXPECT_EQ(pairs, 45);
}

TEST(View, try_get_answers_for_entities_of_the_view_only) {
  TestWorld world;
  const Entity in = world.create(Health{3}, Position{});
  const Entity frozen = world.create(Health{4}, Position{}, Frozen{});
  const Entity lacking = world.create(Health{5});
  const Entity dead = world.create(Health{6}, Position{});
  world.destroy(dead);
  const auto view = world.view<const Health, Position, Maybe<Serial>, Without<Frozen>>();
  static_assert(std::is_same_v<decltype(view.try_get<Health>(in)), const Health*>);
  static_assert(std::is_same_v<decltype(view.try_get<Position>(in)), Position*>);
  ASSERT_NE(view.try_get<Health>(in), nullptr);
  EXPECT_EQ(view.try_get<const Health>(in)->value, 3);
  EXPECT_EQ(view.try_get<Serial>(in), nullptr);
  EXPECT_EQ(view.try_get<Health>(frozen), nullptr);
  EXPECT_EQ(view.try_get<Health>(lacking), nullptr);
  EXPECT_EQ(view.try_get<Health>(dead), nullptr);
  EXPECT_EQ(view.try_get<Health>(kNoEntity), nullptr);
  EXPECT_TRUE(view.contains(in));
  EXPECT_FALSE(view.contains(frozen));
}

TEST(View, a_const_world_gives_reading_views) {
  TestWorld world;
  world.create(Health{1});
  const auto view = std::as_const(world).view<const Health>();
  EXPECT_EQ(view.size(), 1u);
  static_assert(View<const Health, With<Frozen>, Maybe<const Position>>::kReadsOnly);
  static_assert(!View<const Health, Maybe<Position>>::kReadsOnly);
  static_assert(!std::is_constructible_v<View<Health>, const World&>);
}

TEST(View, an_exception_ends_an_iteration) {
  TestWorld world;
  world.create(Health{1});
  EXPECT_THROW(world.view<const Health>().each([](const Health&) { throw 1; }), int);
  world.create(Health{2});
  EXPECT_EQ(world.entity_count(), 2u);
}

}  // namespace
}  // namespace gloam::test
