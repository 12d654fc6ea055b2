// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/ecs/archetype.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <cstring>

#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

constexpr std::array<std::uint32_t, 9> kSizes = {4, 8, 12, 16, 24, 32, 48, 64, 100};
constexpr ComponentId kTag = kSizes.size();

std::vector<ComponentInfo> infos() {
  std::vector<ComponentInfo> result;
  for (const std::uint32_t size : kSizes) result.push_back({"", nullptr, size});
  result.push_back({"tag", nullptr, 0});
  return result;
}

Archetype make_all(std::uint32_t max_rows = 1u << 20) {
  return Archetype(3, {0, 1, 2, 3, 4, 5, 6, 7, 8, kTag}, infos(), max_rows);
}

void write_row(Archetype& archetype, std::uint32_t row, int value) {
  archetype.set_entity(row, {row, 1});
  for (ComponentId id = 0; id < kSizes.size(); ++id) {
    std::memset(archetype.data(id) + row * kSizes[id], value + id, kSizes[id]);
  }
}

bool row_holds(const Archetype& archetype, std::uint32_t row, int value) {
  for (ComponentId id = 0; id < kSizes.size(); ++id) {
    if (!archetype.has(id)) continue;
    for (std::uint32_t i = 0; i < kSizes[id]; ++i) {
      if (archetype.data(id)[row * kSizes[id] + i] != static_cast<std::byte>(value + id)) return false;
    }
  }
  return true;
}

TEST(Archetype, columns_are_aligned_for_every_component) {
  const Archetype archetype = make_all();
  for (ComponentId id = 0; id < kSizes.size(); ++id) {
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(archetype.data(id)) % kColumnAlignment, 0u);
  }
}

TEST(Archetype, values_stay_where_they_are_while_rows_come) {
  Archetype archetype = make_all();
  for (std::uint32_t row = 0; row < 20'000; ++row) {
    ASSERT_EQ(archetype.push_rows(1, 1), row);
    write_row(archetype, row, static_cast<int>(row % 100));
  }
  for (std::uint32_t row = 0; row < 20'000; ++row) ASSERT_TRUE(row_holds(archetype, row, static_cast<int>(row % 100)));
}

TEST(Archetype, the_last_row_fills_the_gap) {
  Archetype archetype = make_all();
  archetype.push_rows(3, 1);
  for (std::uint32_t row = 0; row < 3; ++row) write_row(archetype, row, static_cast<int>(row) * 20);
  EXPECT_EQ(archetype.remove_row(0, 2), (Entity{2, 1}));
  EXPECT_TRUE(row_holds(archetype, 0, 40));
  EXPECT_EQ(archetype.entities()[0], (Entity{2, 1}));
  EXPECT_EQ(archetype.remove_row(1, 2), kNoEntity);
  EXPECT_EQ(archetype.row_count(), 1u);
}

TEST(Archetype, a_row_that_moves_takes_along_what_both_have) {
  Archetype from = make_all();
  Archetype to(4, {1, 4, 8}, infos(), 100);
  from.push_rows(2, 1);
  write_row(from, 1, 7);
  to.push_rows(5, 1);
  EXPECT_EQ(from.move_row(1, from.set_edge(0, to), 4, 2), kNoEntity) << "it was the last";
  EXPECT_TRUE(row_holds(to, 4, 7));
  EXPECT_EQ(to.entities()[4], (Entity{1, 1}));
  EXPECT_EQ(from.row_count(), 1u);
}

TEST(Archetype, the_last_row_fills_the_gap_of_one_that_moves) {
  Archetype from = make_all();
  Archetype to(4, {1, 4, 8}, infos(), 100);
  from.push_rows(3, 1);
  for (std::uint32_t row = 0; row < 3; ++row) write_row(from, row, static_cast<int>(row) * 20);
  to.push_rows(1, 1);
  EXPECT_EQ(from.move_row(0, from.set_edge(0, to), 0, 5), (Entity{2, 1}));
  EXPECT_TRUE(row_holds(to, 0, 0));
  EXPECT_TRUE(row_holds(from, 0, 40));
  EXPECT_TRUE(row_holds(from, 1, 20));
  EXPECT_TRUE(from.changed(0, 0, 4));
}

TEST(Archetype, rows_of_any_size_move_whole) {
  for (std::uint32_t size = 1; size <= 80; ++size) {
    const std::vector<ComponentInfo> sized = {{"", nullptr, size}};
    Archetype from(0, {0}, sized, 10);
    Archetype to(1, {0}, sized, 10);
    from.push_rows(2, 1);
    to.push_rows(2, 1);
    for (std::uint32_t i = 0; i < 2 * size; ++i) from.data(0)[i] = static_cast<std::byte>(i + 1);
    static_cast<void>(from.move_row(0, from.set_edge(0, to), 0, 1));
    for (std::uint32_t i = 0; i < size; ++i) {
      ASSERT_EQ(to.data(0)[i], static_cast<std::byte>(i + 1)) << size;
      ASSERT_EQ(to.data(0)[size + i], std::byte{0}) << size;
      ASSERT_EQ(from.data(0)[i], static_cast<std::byte>(size + i + 1)) << size;
    }
  }
}

TEST(Archetype, knows_ids_that_came_later) {
  Archetype archetype = make_all();
  std::byte* const column = archetype.data(3);
  archetype.cover_ids(1000);
  EXPECT_FALSE(archetype.has(999));
  EXPECT_EQ(archetype.data(3), column);
}

TEST(Archetype, a_tag_is_there_without_bytes) {
  const Archetype with(0, {kTag}, infos(), 10);
  const Archetype without(1, {}, infos(), 10);
  EXPECT_TRUE(with.has(kTag));
  EXPECT_FALSE(with.has(0));
  EXPECT_FALSE(without.has(kTag));
}

TEST(Archetype, stamps_blocks_of_rows_that_came_moved_or_were_marked) {
  Archetype archetype(0, {0, 1}, infos(), 1u << 20);
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

TEST(Archetype, remembers_its_neighbours) {
  Archetype a(0, {}, infos(), 10);
  Archetype b(1, {5}, infos(), 10);
  EXPECT_EQ(a.edge(5), nullptr);
  a.set_edge(5, b);
  ASSERT_NE(a.edge(5), nullptr);
  EXPECT_EQ(a.edge(5)->to, &b);
  EXPECT_EQ(a.edge(4), nullptr);
}

TEST(Archetype, holds_exactly_as_many_rows_as_it_reserved) {
  Archetype archetype = make_all(1000);
  archetype.push_rows(1000, 1);
  for (std::uint32_t row = 0; row < 1000; ++row) write_row(archetype, row, 1);
  EXPECT_TRUE(row_holds(archetype, 999, 1));
  EXPECT_ASSERT((void)archetype.push_rows(1, 1), "raise WorldLimits::max_rows_per_archetype");
}

}  // namespace
}  // namespace gloam
