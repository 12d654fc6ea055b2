// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/ecs/view.h"
#include "engine/jobs/executor.h"
#include "tests/ecs/components.h"
#include "tests/support/expect_assert.h"

namespace gloam::test {
namespace {

constexpr std::size_t kBlock = kTickBlockRows;

struct Fixture {
  TestWorld world;
  std::vector<Entity> entities = std::vector<Entity>(kBlock * 4 + 100);
  View<Health, const Position> view = world.view<Health, const Position>();
  Tick seen = 0;

  Fixture() { world.create_bulk(entities, Health{1}, Position{}); }

  /// First row and length of each range reported since the last call.
  template <class T>
  std::vector<std::pair<std::size_t, std::size_t>> news() {
    std::vector<std::pair<std::size_t, std::size_t>> result;
    const Health* base = &std::as_const(world).get<Health>(entities[0]);
    seen = view.changed_since<T>(
        seen, [&](std::span<const Entity> range, std::span<Health> health, std::span<const Position> positions) {
          EXPECT_EQ(range.size(), health.size());
          EXPECT_EQ(range.size(), positions.size());
          result.emplace_back(health.data() - base, health.size());
        });
    return result;
  }
};
using Ranges = std::vector<std::pair<std::size_t, std::size_t>>;

TEST(ViewChanges, everything_is_news_once) {
  Fixture f;
  EXPECT_EQ(f.news<Health>(), (Ranges{{0, kBlock * 4 + 100}}));
  EXPECT_EQ(f.news<Health>(), Ranges{});
}

TEST(ViewChanges, a_write_is_news_only_when_marked_and_in_its_block) {
  Fixture f;
  (void)f.news<Health>();
  f.world.get<Health>(f.entities[kBlock * 2 + 5]).value = 3;
  EXPECT_EQ(f.news<Health>(), Ranges{});
  f.world.mark_changed<Health>(f.entities[kBlock * 2 + 5]);
  EXPECT_EQ(f.news<Health>(), (Ranges{{kBlock * 2, kBlock}}));
  f.view.mark_changed<Health>(f.entities[kBlock * 4 + 5]);
  EXPECT_EQ(f.news<Health>(), (Ranges{{kBlock * 4, 100}}));
}

TEST(ViewChanges, columns_are_marked_apart) {
  Fixture f;
  (void)f.news<Health>();
  f.view.mark_changed<Health>();
  const Tick before = f.seen;
  EXPECT_EQ(f.news<Position>(), Ranges{});
  f.seen = before;
  EXPECT_EQ(f.news<Health>(), (Ranges{{0, kBlock * 4 + 100}}));
}

TEST(ViewChanges, neighbouring_blocks_are_one_range) {
  Fixture f;
  (void)f.news<Health>();
  f.view.each_chunk([&](std::span<const Entity> range, std::span<Health>, std::span<const Position>) {
    f.view.mark_changed<Health>(range.subspan(kBlock - 1, 2));
    f.view.mark_changed<Health>(range.subspan(kBlock * 3, 1));
    f.view.mark_changed<Health>(range.first(0));
  });
  EXPECT_EQ(f.news<Health>(), (Ranges{{0, kBlock * 2}, {kBlock * 3, kBlock}}));
}

TEST(ViewChanges, a_change_behind_a_reader_is_news_to_it_next_time) {
  Fixture f;
  (void)f.news<Health>();
  const Tick tick = f.world.tick();
  f.view.mark_changed<Health>(f.entities[0]);  // after changed_since, before the tick advances again
  EXPECT_EQ(f.world.tick(), tick);
  EXPECT_EQ(f.news<Health>(), (Ranges{{0, kBlock}}));
}

TEST(ViewChanges, readers_do_not_take_news_from_each_other) {
  Fixture f;
  Tick other = f.view.changed_since<Health>(0, [](std::span<Health>, std::span<const Position>) {});
  (void)f.news<Health>();
  f.view.mark_changed<Health>(f.entities[0]);
  EXPECT_EQ(f.news<Health>().size(), 1u);
  std::size_t ranges = 0;
  other = f.view.changed_since<Health>(other, [&](std::span<Health>, std::span<const Position>) { ++ranges; });
  EXPECT_EQ(ranges, 1u);
  EXPECT_LT(other, f.world.tick());
}

TEST(ViewChanges, rows_that_come_or_move_are_news) {
  Fixture f;
  (void)f.news<Health>();
  f.world.destroy(f.entities[kBlock + 7]);  // the last row moves into block 1
  EXPECT_EQ(f.news<Health>(), (Ranges{{kBlock, kBlock}}));
  f.world.create(Position{}, Health{});
  EXPECT_EQ(f.news<Health>(), (Ranges{{kBlock * 4, 100}}));
  f.world.add<Frozen>(f.entities[3]);  // moves to another archetype; the last row takes its place
  std::size_t rows = 0;
  f.seen =
      f.view.changed_since<Health>(f.seen, [&](std::span<Health> h, std::span<const Position>) { rows += h.size(); });
  EXPECT_EQ(rows, kBlock + 1);
  f.world.add<Health>(f.entities[3], {9});  // overwrites
  rows = 0;
  f.seen =
      f.view.changed_since<Health>(f.seen, [&](std::span<Health> h, std::span<const Position>) { rows += h.size(); });
  EXPECT_EQ(rows, 1u);
}

TEST(ViewChanges, advance_tick_returns_the_tick_that_ended) {
  World world;
  const Tick tick = world.tick();
  EXPECT_GE(tick, 1u);
  EXPECT_EQ(world.advance_tick(), tick);
  EXPECT_EQ(world.tick(), tick + 1);
}

TEST(ViewChanges, ranges_that_share_a_block_may_mark_it_together) {
  Fixture f;
  (void)f.news<Health>();
  const auto executor = make_pool_executor(2);
  f.view.parallel_chunks(*executor, 100,
                         [&](std::size_t, std::span<const Entity> range, std::span<Health>, std::span<const Position>) {
                           f.view.mark_changed<Health>(range);
                         });
  EXPECT_EQ(f.news<Health>(), (Ranges{{0, kBlock * 4 + 100}}));
}

TEST(ViewChanges, marking_what_is_not_there_asserts) {
  Fixture f;
  const Entity lacking = f.world.create();
  EXPECT_ASSERT(f.view.mark_changed<Health>(lacking), "entities that have the component");
  EXPECT_ASSERT(f.view.mark_changed<Health>(kNoEntity), "not alive");
  EXPECT_ASSERT(f.view.mark_changed<Health>(std::span<const Entity>(f.entities)), "a view's own entities");
}

}  // namespace
}  // namespace gloam::test
