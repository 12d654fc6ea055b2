// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/jobs/executor.h"
#include "tests/ecs/components.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

std::vector<std::unique_ptr<JobExecutor>> executors() {
  std::vector<std::unique_ptr<JobExecutor>> result;
  result.push_back(make_serial_executor());
  result.push_back(make_shuffled_executor(7));
  result.push_back(make_pool_executor(1));
  result.push_back(make_pool_executor(2));
  result.push_back(make_pool_executor(8));
  return result;
}

/// Makes archetypes with 1,000 rows, 1 row, no row and 7 rows.
void populate(TestWorld& world) {
  std::vector<Entity> made(1000);
  world.create_bulk(made, Health{1}, Serial{});
  world.create(Health{2}, Serial{}, Frozen{});
  world.destroy(world.create(Health{2}, Serial{}, Frozen{}, Visible{}));
  for (int i = 0; i < 7; ++i) world.create(Health{3}, Serial{}, Position{});
}

TEST(ViewParallel, parallel_each_visits_every_row_once) {
  for (const auto& executor : executors()) {
    for (const std::size_t grain : {std::size_t{1}, std::size_t{64}, std::size_t{100'000}}) {
      TestWorld world;
      populate(world);
      const auto view = world.view<const Health, Serial>();
      view.parallel_each(*executor, grain, [](Entity, const Health& health, Serial& serial) {
        serial.value += static_cast<std::uint64_t>(health.value);
      });
      std::size_t wrong = 0;
      view.each([&](const Health& health, Serial& serial) { wrong += static_cast<int>(serial.value) != health.value; });
      EXPECT_EQ(wrong, 0u);
    }
  }
}

TEST(ViewParallel, ordinals_count_the_ranges_in_order_whoever_runs_them) {
  struct Range {
    const Health* first = nullptr;
    std::size_t count = 0;
    Entity entity;
  };
  TestWorld world;
  populate(world);
  const auto view = world.view<const Health>();
  for (const auto& executor : executors()) {
    std::vector<Range> ranges(view.chunk_count(300));
    ASSERT_EQ(ranges.size(), 6u);
    view.parallel_chunks(*executor, 300,
                         [&](std::size_t ordinal, std::span<const Entity> entities, std::span<const Health> health) {
                           ranges[ordinal] = {health.data(), health.size(), entities[0]};
                         });
    const std::vector<std::size_t> sizes = {300, 300, 300, 100, 1, 7};
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      EXPECT_EQ(ranges[i].count, sizes[i]);
      EXPECT_EQ(ranges[i].first, &std::as_const(world).get<Health>(ranges[i].entity));
    }
    EXPECT_EQ(ranges[1].first, ranges[0].first + 300);
  }
}

TEST(ViewParallel, ranges_may_leave_out_the_entities) {
  TestWorld world;
  populate(world);
  std::vector<std::size_t> rows(world.view<Health>().chunk_count(512));
  world.view<Health>().parallel_chunks(
      *make_serial_executor(), 512,
      [&](std::size_t ordinal, std::span<Health> health) { rows[ordinal] = health.size(); });
  EXPECT_EQ(rows, (std::vector<std::size_t>{512, 488, 1, 7}));
}

TEST(ViewParallel, no_range_lies_across_the_joint_of_an_archetype) {
  TestWorld world;
  for (int i = 0; i < 1000; ++i) world.create(Health{i});
  const auto view = world.view<const Health>();
  for (const auto& executor : executors()) {
    for (const std::size_t grain : {std::size_t{50}, std::size_t{kFrontRows}, std::size_t{300}, ~std::size_t{0}}) {
      std::vector<std::vector<int>> seen(view.chunk_count(grain));
      view.parallel_chunks(*executor, grain, [&](std::size_t ordinal, std::span<const Health> health) {
        for (const Health& h : health) seen[ordinal].push_back(h.value);
      });
      int next = 0;
      for (const std::vector<int>& range : seen) {
        EXPECT_FALSE(range.empty());
        EXPECT_LE(range.size(), grain);
        for (const int value : range) EXPECT_EQ(value, next++);
      }
      EXPECT_EQ(next, 1000);
    }
  }
}

TEST(ViewParallel, many_small_archetypes_are_few_jobs) {
  TestWorld world;
  populate(world);
  Query query({.columns = {world.component_id<Health>()}, .required = {world.component_id<Health>()}, .excluded = {}});
  query.extend(world.archetypes());
  const ChunkPlan plan = plan_chunks(query, 900);
  EXPECT_EQ(plan.chunks.size(), 4u);
  EXPECT_EQ(plan.job_ends, (std::vector<std::uint32_t>{1, 4}));
}

TEST(ViewParallel, an_empty_view_runs_nothing) {
  TestWorld world;
  const auto view = world.view<const Health>();
  EXPECT_EQ(view.chunk_count(1), 0u);
  view.parallel_each(*make_pool_executor(2), 1, [](const Health&) { FAIL(); });
}

TEST(ViewParallel, structural_changes_in_a_range_assert) {
  TestWorld world;
  populate(world);
  EXPECT_ASSERT(world.view<const Health>().parallel_each(*make_serial_executor(), 8,
                                                         [&](Entity e, const Health&) { world.destroy(e); }),
                "record it in a CommandBuffer");
  EXPECT_EQ(world.view<const Health>().size(), 1008u);
}

TEST(ViewParallel, a_grain_of_nothing_asserts) {
  TestWorld world;
  EXPECT_ASSERT(world.view<const Health>().parallel_each(*make_serial_executor(), 0, [](const Health&) {}),
                "at least one row");
  EXPECT_ASSERT((void)world.view<const Health>().chunk_count(0), "at least one row");
}

TEST(ViewParallel, views_are_taken_and_iterated_from_many_threads) {
  TestWorld world;
  populate(world);
  std::vector<int> sums(8);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < sums.size(); ++t) {
    threads.emplace_back([&world, &sum = sums[t], t] {
      for (int i = 0; i < 50; ++i) {
        if (t % 2 == 0) {
          world.view<const Health>().each([&](const Health& health) { sum += health.value; });
        } else {
          std::as_const(world).view<const Health, Maybe<const Position>, With<Serial>>().each(
              [&](const Health& health, const Position*) { sum += health.value; });
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(sums, std::vector<int>(8, 50 * (1000 + 2 + 21)));
}

}  // namespace
}  // namespace gloam::test
