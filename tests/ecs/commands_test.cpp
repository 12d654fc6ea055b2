// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/commands.h"

#include <gtest/gtest.h>

#include <vector>

#include "engine/ecs/view.h"
#include "engine/jobs/executor.h"
#include "tests/ecs/components.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

TEST(CommandBuffer, changes_nothing_until_it_is_applied) {
  TestWorld world;
  const Entity e = world.create(Health{1});
  CommandBuffer commands;
  commands.destroy(e);
  commands.create(Health{2}, Frozen{}, Big{});
  EXPECT_EQ(commands.size(), 2u);
  EXPECT_TRUE(world.alive(e));
  const CommandReport report = commands.apply(world);
  EXPECT_EQ(report.applied, 2u);
  EXPECT_EQ(report.skipped, 0u);
  EXPECT_FALSE(world.alive(e));
  EXPECT_EQ((world.view<const Health, With<Frozen>>().size()), 1u);
  EXPECT_TRUE(commands.empty());
  EXPECT_EQ(commands.apply(world).applied, 0u);
}

TEST(CommandBuffer, values_keep_their_order_and_bytes) {
  TestWorld world;
  CommandBuffer commands;
  for (int i = 0; i < 1000; ++i) {
    Big big;
    big.words[20] = static_cast<std::uint32_t>(i);
    commands.create(Serial{static_cast<std::uint64_t>(i)}, Health{i}, Visible{}, big, Position{0, 0, 1});
  }
  commands.apply(world);
  int next = 0;
  world.view<const Serial, const Health, const Big, const Position, With<Visible>>().each(
      [&](const Serial& serial, const Health& health, const Big& big, const Position& position) {
        ASSERT_EQ(serial.value, static_cast<std::uint64_t>(next));
        ASSERT_EQ(health.value, next);
        ASSERT_EQ(big.words[20], static_cast<std::uint32_t>(next));
        ASSERT_EQ(position.z, 1);
        ++next;
      });
  EXPECT_EQ(next, 1000);
}

TEST(CommandBuffer, a_stand_in_names_what_the_buffer_creates) {
  TestWorld world;
  CommandBuffer commands;
  const Entity first = commands.create(Health{1});
  const Entity second = commands.create();
  const Entity third = commands.create(Health{3}, Position{});
  commands.add<Frozen>(first);
  commands.add(second, Health{2});
  commands.remove<Position>(third);
  commands.destroy(first);
  EXPECT_FALSE(world.alive(first));
  commands.apply(world);
  EXPECT_EQ(world.entity_count(), 2u);
  int sum = 0;
  world.view<const Health, Without<Position>>().each([&](const Health& health) { sum += health.value; });
  EXPECT_EQ(sum, 5);
}

TEST(CommandBuffer, skips_what_is_dead_by_then) {
  TestWorld world;
  const Entity e = world.create(Health{1});
  CommandBuffer commands;
  commands.add<Position>(e);
  commands.destroy(e);
  commands.destroy(e);
  commands.remove<Health>(e);
  commands.add<Frozen>(e);
  const CommandReport report = commands.apply(world);
  EXPECT_EQ(report.applied, 2u);
  EXPECT_EQ(report.skipped, 3u);
}

TEST(CommandBuffer, a_cleared_buffer_does_nothing) {
  TestWorld world;
  CommandBuffer commands;
  commands.create(Health{1});
  commands.clear();
  EXPECT_EQ(commands.apply(world).applied, 0u);
  EXPECT_EQ(world.entity_count(), 0u);
}

TEST(CommandBuffer, misuse_asserts) {
  TestWorld world;
  world.create(Health{1});
  CommandBuffer commands;
  CommandBuffer other;
  const Entity stand_in = other.create();
  EXPECT_ASSERT(commands.destroy(stand_in), "belongs to the buffer that created it");
  EXPECT_ASSERT(commands.destroy(kNoEntity), "belongs to the buffer");
  EXPECT_ASSERT(commands.add<Frozen>(kNoEntity), "belongs to the buffer");
  EXPECT_ASSERT(commands.remove<Frozen>(kNoEntity), "belongs to the buffer");
  EXPECT_ASSERT(world.view<const Health>().each([&](const Health&) { other.apply(world); }), "while a view iterates");
}

/// Records in parallel: a new entity for every third one, the destruction of every fifth and a tag for every seventh.
/// Returns the entities and values in their final order.
std::vector<int> run_with(JobExecutor& executor, std::size_t grain) {
  TestWorld world;
  for (int i = 0; i < 2000; ++i) {
    const Entity e = world.create(Health{i});
    if (i % 4 == 0) world.add<Position>(e);
  }
  const auto view = world.view<const Health>();
  CommandLists lists;
  lists.prepare(view.chunk_count(grain));
  view.parallel_chunks(executor, grain,
                       [&](std::size_t ordinal, std::span<const Entity> entities, std::span<const Health> health) {
                         CommandBuffer& commands = lists[ordinal];
                         for (std::size_t i = 0; i < entities.size(); ++i) {
                           const int value = health[i].value;
                           if (value % 3 == 0) commands.add<Visible>(commands.create(Health{value + 10'000}));
                           if (value % 5 == 0) commands.destroy(entities[i]);
                           if (value % 7 == 0) commands.add<Frozen>(entities[i]);
                         }
                       });
  const CommandReport report = lists.apply(world);
  EXPECT_EQ(report.skipped, 58u) << "multiples of 35 below 2000";
  std::vector<int> order;
  view.each([&](Entity e, const Health& health) {
    order.push_back(static_cast<int>(e.index));
    order.push_back(health.value);
  });
  return order;
}

TEST(CommandLists, the_outcome_does_not_depend_on_threads_or_ranges) {
  const std::vector<int> expected = run_with(*make_serial_executor(), 1'000'000);
  EXPECT_EQ(expected.size(), 2u * (2000 + 667 - 400));
  for (const std::size_t grain : {std::size_t{1}, std::size_t{33}, std::size_t{500}}) {
    EXPECT_EQ(run_with(*make_serial_executor(), grain), expected);
    EXPECT_EQ(run_with(*make_shuffled_executor(grain), grain), expected);
    EXPECT_EQ(run_with(*make_pool_executor(2), grain), expected);
    EXPECT_EQ(run_with(*make_pool_executor(8), grain), expected);
  }
}

TEST(CommandLists, are_prepared_for_every_range_and_applied_before_the_next_loop) {
  TestWorld world;
  CommandLists lists;
  EXPECT_ASSERT((void)lists[0], "prepared for every range");
  lists.prepare(2);
  lists[1].create(Health{1});
  EXPECT_ASSERT(lists.prepare(2), "applied before they are used again");
  lists.clear();
  lists.prepare(3);
  EXPECT_EQ(lists.size(), 3u);
  lists[2].create(Health{2});
  lists[0].create(Health{1});
  lists.apply(world);
  std::vector<int> values;
  world.view<const Health>().each([&](const Health& health) { values.push_back(health.value); });
  EXPECT_EQ(values, (std::vector{1, 2}));
}

}  // namespace
}  // namespace gloam::test
