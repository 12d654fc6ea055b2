// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/storage/archetype.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <deque>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

constexpr std::array<std::uint32_t, 9> kSizes = {4, 8, 12, 16, 24, 32, 48, 64, 100};
constexpr ComponentId kTag = kSizes.size();

std::vector<ComponentInfo> infos() {
  std::vector<ComponentInfo> result;
  for (const std::uint32_t size : kSizes) result.push_back({"", TypeKey::none, size});
  result.push_back({"tag", TypeKey::none, 0});
  return result;
}

/// Makes archetypes that share the memory of their fronts, as in one world.
struct ArchetypeTest : testing::Test {
  FrontMemory fronts;

  Archetype make(std::uint32_t index, std::vector<ComponentId> components, std::uint32_t max_rows = 1u << 20) {
    return Archetype(index, std::move(components), infos(), max_rows, fronts);
  }
  Archetype make_all(std::uint32_t max_rows = 1u << 20) { return make(3, {0, 1, 2, 3, 4, 5, 6, 7, 8, kTag}, max_rows); }
};

std::byte* cell(const Archetype& archetype, ComponentId id, std::uint32_t row) {
  return archetype.base(id, row) + row * kSizes[id];
}

void write_row(Archetype& archetype, std::uint32_t row, int value) {
  archetype.set_entity(row, {row, 1});
  for (ComponentId id = 0; id < kSizes.size(); ++id) {
    std::memset(cell(archetype, id, row), value + id, kSizes[id]);
  }
}

bool row_holds(const Archetype& archetype, std::uint32_t row, int value) {
  for (ComponentId id = 0; id < kSizes.size(); ++id) {
    if (!archetype.has(id)) continue;
    for (std::uint32_t i = 0; i < kSizes[id]; ++i) {
      if (cell(archetype, id, row)[i] != static_cast<std::byte>(value + id)) return false;
    }
  }
  return true;
}

TEST_F(ArchetypeTest, columns_are_aligned_for_every_component) {
  Archetype archetype = make_all();
  archetype.push_rows(10, 1);
  archetype.push_rows(1000, 1);
  for (ComponentId id = 0; id < kSizes.size(); ++id) {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(archetype.front(id)) % kColumnAlignment, 0u);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(archetype.base(id, 1000)) % kColumnAlignment, 0u);
  }
}

TEST_F(ArchetypeTest, values_stay_where_they_are_while_rows_come) {
  Archetype archetype = make_all();
  std::vector<const std::byte*> places;
  for (std::uint32_t row = 0; row < 20'000; ++row) {
    ASSERT_EQ(archetype.push_rows(1, 1), row);
    write_row(archetype, row, static_cast<int>(row % 100));
    for (ComponentId id = 0; id < kSizes.size(); ++id) places.push_back(cell(archetype, id, row));
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto row = static_cast<std::uint32_t>(i / kSizes.size());
    ASSERT_EQ(cell(archetype, static_cast<ComponentId>(i % kSizes.size()), row), places[i]);
    ASSERT_EQ(archetype.entities(row)[row], (Entity{row, 1}));
  }
  for (std::uint32_t row = 0; row < 20'000; ++row) ASSERT_TRUE(row_holds(archetype, row, static_cast<int>(row % 100)));
}

TEST_F(ArchetypeTest, small_ones_share_pages) {
  std::deque<Archetype> archetypes;
  for (std::uint32_t i = 0; i < 8; ++i) {
    archetypes.emplace_back(i, std::vector<ComponentId>{0, 1, 2}, infos(), 1u << 20, fronts);
    archetypes[i].push_rows(kFrontRows, 1);
  }
  EXPECT_EQ(archetypes[0].front_rows(), kFrontRows);
  const std::ptrdiff_t rows = 8 * std::ptrdiff_t{kFrontRows};
  const std::ptrdiff_t row_bytes = sizeof(Entity) + 4 + 8 + 12;
  EXPECT_LE(archetypes[7].front(2) - archetypes[0].front(0), rows * row_bytes + 8 * 64);
}

TEST_F(ArchetypeTest, a_front_takes_a_few_pages_at_most) {
  const std::vector<ComponentInfo> large = {{"", TypeKey::none, 1000}, {"", TypeKey::none, 100'000}};
  Archetype some(0, {0}, large, 1u << 20, fronts);
  some.push_rows(1, 1);
  EXPECT_EQ(some.front_rows(), kFrontBytes / 1008);
  Archetype none(1, {1}, large, 1000, fronts);
  none.push_rows(3, 1);
  EXPECT_EQ(none.front_rows(), 0u);
  EXPECT_TRUE(none.has(1));
  std::memset(none.base(1, 0), 1, 300'000);
}

TEST_F(ArchetypeTest, columns_have_one_joint) {
  Archetype archetype = make_all();
  archetype.push_rows(1, 1);
  const std::uint32_t front = archetype.front_rows();
  EXPECT_GT(front, 3u);
  for (int i = 0; i < 1000; ++i) archetype.push_rows(1, 1);
  EXPECT_EQ(archetype.front_rows(), front);
  EXPECT_EQ(archetype.range_end(0, 1001), front);
  EXPECT_EQ(archetype.range_end(0, front), front);
  EXPECT_EQ(archetype.range_end(1, 3), 3u);
  EXPECT_EQ(archetype.range_end(front, 1001), 1001u);
}

TEST_F(ArchetypeTest, rows_that_come_at_once_are_not_torn) {
  Archetype archetype = make_all();
  archetype.push_rows(3, 1);
  const std::byte* const first = cell(archetype, 0, 0);
  archetype.push_rows(1000, 1);
  EXPECT_EQ(cell(archetype, 0, 0), first);
  EXPECT_EQ(archetype.range_end(0, 1003), 3u);
  EXPECT_EQ(archetype.range_end(3, 1003), 1003u);
  for (std::uint32_t row = 0; row < 1003; ++row) write_row(archetype, row, static_cast<int>(row % 100));
  for (std::uint32_t row = 1003; row-- > 2;) static_cast<void>(archetype.remove_row(row, 1));
  archetype.push_rows(1, 1);
  archetype.push_rows(300, 1);
  EXPECT_EQ(archetype.range_end(0, 303), 3u);
  EXPECT_TRUE(row_holds(archetype, 1, 1));
}

TEST_F(ArchetypeTest, many_rows_at_once_in_an_empty_one_have_no_joint) {
  Archetype archetype = make_all();
  archetype.push_rows(1000, 1);
  EXPECT_EQ(archetype.range_end(0, 1000), 1000u);
  for (std::uint32_t row = 0; row < 1000; ++row) archetype.set_entity(row, {row, 1});
  for (std::uint32_t row = 1000; row-- > 0;) static_cast<void>(archetype.remove_row(row, 1));
  archetype.push_rows(2, 1);
  EXPECT_LT(archetype.range_end(0, 1000), 1000u) << "small again";
}

TEST_F(ArchetypeTest, rows_pass_the_joint) {
  Archetype archetype = make_all();
  Archetype other = make(4, {1, 4, 8});
  for (std::uint32_t row = 0; row < 300; ++row) {
    archetype.push_rows(1, 1);
    write_row(archetype, row, static_cast<int>(row % 100));
  }
  EXPECT_EQ(archetype.remove_row(2, 1), (Entity{299, 1}));
  EXPECT_TRUE(row_holds(archetype, 2, 99));
  other.push_rows(200, 1);
  EXPECT_EQ(archetype.move_row(3, archetype.set_edge(0, other), 199, 1), (Entity{298, 1}));
  EXPECT_TRUE(row_holds(archetype, 3, 98));
  EXPECT_TRUE(row_holds(other, 199, 3));
  EXPECT_EQ(other.entities(199)[199], (Entity{3, 1}));
}

TEST_F(ArchetypeTest, the_last_row_fills_the_gap) {
  Archetype archetype = make_all();
  archetype.push_rows(3, 1);
  for (std::uint32_t row = 0; row < 3; ++row) write_row(archetype, row, static_cast<int>(row) * 20);
  EXPECT_EQ(archetype.remove_row(0, 2), (Entity{2, 1}));
  EXPECT_TRUE(row_holds(archetype, 0, 40));
  EXPECT_EQ(archetype.entities(0)[0], (Entity{2, 1}));
  EXPECT_EQ(archetype.remove_row(1, 2), kNoEntity);
  EXPECT_EQ(archetype.row_count(), 1u);
}

TEST_F(ArchetypeTest, a_row_that_moves_takes_along_what_both_have) {
  Archetype from = make_all();
  Archetype to = make(4, {1, 4, 8}, 100);
  from.push_rows(2, 1);
  write_row(from, 1, 7);
  to.push_rows(5, 1);
  EXPECT_EQ(from.move_row(1, from.set_edge(0, to), 4, 2), kNoEntity) << "it was the last";
  EXPECT_TRUE(row_holds(to, 4, 7));
  EXPECT_EQ(to.entities(4)[4], (Entity{1, 1}));
  EXPECT_EQ(from.row_count(), 1u);
}

TEST_F(ArchetypeTest, the_last_row_fills_the_gap_of_one_that_moves) {
  Archetype from = make_all();
  Archetype to = make(4, {1, 4, 8}, 100);
  from.push_rows(3, 1);
  for (std::uint32_t row = 0; row < 3; ++row) write_row(from, row, static_cast<int>(row) * 20);
  to.push_rows(1, 1);
  EXPECT_EQ(from.move_row(0, from.set_edge(0, to), 0, 5), (Entity{2, 1}));
  EXPECT_TRUE(row_holds(to, 0, 0));
  EXPECT_TRUE(row_holds(from, 0, 40));
  EXPECT_TRUE(row_holds(from, 1, 20));
  EXPECT_TRUE(from.changed(0, 0, 4));
}

TEST_F(ArchetypeTest, rows_of_any_size_move_whole) {
  for (std::uint32_t size = 1; size <= 80; ++size) {
    const std::vector<ComponentInfo> sized = {{"", TypeKey::none, size}};
    Archetype from(0, {0}, sized, 10, fronts);
    Archetype to(1, {0}, sized, 10, fronts);
    from.push_rows(2, 1);
    to.push_rows(2, 1);
    for (std::uint32_t i = 0; i < 2 * size; ++i) from.base(0, 0)[i] = static_cast<std::byte>(i + 1);
    static_cast<void>(from.move_row(0, from.set_edge(0, to), 0, 1));
    for (std::uint32_t i = 0; i < size; ++i) {
      ASSERT_EQ(to.base(0, 0)[i], static_cast<std::byte>(i + 1)) << size;
      ASSERT_EQ(to.base(0, 0)[size + i], std::byte{0}) << size;
      ASSERT_EQ(from.base(0, 0)[i], static_cast<std::byte>(size + i + 1)) << size;
    }
  }
}

TEST_F(ArchetypeTest, knows_ids_that_came_later) {
  Archetype archetype = make_all();
  std::byte* const column = archetype.front(3);
  EXPECT_FALSE(archetype.cover_ids(11)) << "there is room for some";
  EXPECT_TRUE(archetype.cover_ids(1000));
  EXPECT_EQ(&archetype.range(0).archetype(), &archetype);
  EXPECT_FALSE(archetype.has(999));
  EXPECT_EQ(archetype.front(3), column);
}

TEST_F(ArchetypeTest, a_tag_is_there_without_bytes) {
  const Archetype with = make(0, {kTag}, 10);
  const Archetype without = make(1, {}, 10);
  EXPECT_TRUE(with.has(kTag));
  EXPECT_FALSE(with.has(0));
  EXPECT_FALSE(without.has(kTag));
}

TEST_F(ArchetypeTest, stamps_blocks_of_rows_that_came_moved_or_were_marked) {
  Archetype archetype = make(0, {0, 1});
  archetype.push_rows(kTickBlockRows * 3, 5);
  EXPECT_EQ(archetype.block_count(), 3u);
  EXPECT_TRUE(archetype.changed(0, 2, 4));
  EXPECT_FALSE(archetype.changed(0, 2, 5));

  archetype.mark_changed(1, kTickBlockRows - 1, 2, 6);
  EXPECT_TRUE(archetype.changed(1, 0, 5));
  EXPECT_TRUE(archetype.changed(1, 1, 5));
  EXPECT_FALSE(archetype.changed(1, 2, 5));
  EXPECT_FALSE(archetype.changed(0, 0, 5)) << "the other column was not marked";

  archetype.remove_row(kTickBlockRows * 2, 7);
  EXPECT_TRUE(archetype.changed(0, 2, 6));
  EXPECT_FALSE(archetype.changed(0, 1, 6));
}

TEST_F(ArchetypeTest, remembers_its_neighbours) {
  Archetype a = make(0, {}, 10);
  Archetype b = make(1, {5}, 10);
  EXPECT_EQ(a.edge(5), nullptr);
  a.set_edge(5, b);
  ASSERT_NE(a.edge(5), nullptr);
  EXPECT_EQ(a.edge(5)->to, &b);
  EXPECT_EQ(a.edge(4), nullptr);
}

TEST_F(ArchetypeTest, holds_exactly_as_many_rows_as_it_reserved) {
  Archetype archetype = make_all(1000);
  archetype.push_rows(1000, 1);
  for (std::uint32_t row = 0; row < 1000; ++row) write_row(archetype, row, 1);
  EXPECT_TRUE(row_holds(archetype, 999, 1));
  EXPECT_ASSERT((void)archetype.push_rows(1, 1), "raise WorldLimits::max_rows_per_archetype");
}

}  // namespace
}  // namespace gloam
