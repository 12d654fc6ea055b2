// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/readback/item_need.h"

#include <gtest/gtest.h>

#include "tests/support/view_frames.h"

namespace gloam {
namespace {

using test::view_at;

TEST(ExpectedItems, is_the_bound_while_nothing_is_known) {
  EXPECT_EQ(expected_items(std::nullopt, 1000, view_at(7, 7)), 1000u);
  EXPECT_EQ(expected_items(std::nullopt, 0, view_at(7, 7)), 0u);
}

TEST(ExpectedItems, is_the_bound_until_a_frame_since_the_camera_cut_is_known) {
  const ItemNeed known{.asked = 10, .bound = 500, .frame = 6};
  EXPECT_EQ(expected_items(known, 1000, view_at(8, 7)), 1000u);
  EXPECT_EQ(expected_items(known, 400, view_at(8, 6)), 10u);
}

TEST(ExpectedItems, grows_with_the_bound_and_never_beyond_it) {
  const ItemNeed known{.asked = 11, .bound = 100, .frame = 1};
  EXPECT_EQ(expected_items(known, 100, view_at(3, 0)), 11u);
  EXPECT_EQ(expected_items(known, 300, view_at(3, 0)), 33u);
  EXPECT_EQ(expected_items(known, 101, view_at(3, 0)), 12u) << "rounded up";
  EXPECT_EQ(expected_items(known, 5, view_at(3, 0)), 5u);
  EXPECT_EQ(expected_items(ItemNeed{.asked = 0, .bound = 0, .frame = 1}, 300, view_at(3, 0)), 0u);
  EXPECT_EQ(expected_items(ItemNeed{.asked = 100, .bound = 100, .frame = 1}, ~std::uint64_t{0} >> 8, view_at(3, 0)),
            ~std::uint64_t{0} >> 8);
}

TEST(RoomForItems, is_the_bound_where_that_is_cheap_and_half_more_than_expected_elsewhere) {
  const ItemNeed known{.asked = 100, .bound = 10000, .frame = 1};
  EXPECT_EQ(room_for_items(known, 1024, 1024, view_at(3, 0)), 1024u);
  EXPECT_EQ(room_for_items(known, 10000, 128, view_at(3, 0)), coarse_capacity(1250)) << "an eighth of the bound";
  EXPECT_EQ(room_for_items(known, 10000, 2048, view_at(3, 0)), 2048u) << "what is cheap";
  EXPECT_EQ(room_for_items(ItemNeed{.asked = 4096, .bound = 10000, .frame = 1}, 10000, 128, view_at(3, 0)), 6144u);
  EXPECT_EQ(room_for_items(ItemNeed{.asked = 9999, .bound = 10000, .frame = 1}, 10000, 128, view_at(3, 0)),
            coarse_capacity(10000));
  EXPECT_EQ(room_for_items(std::nullopt, 10000, 128, view_at(3, 0)), coarse_capacity(10000));
}

TEST(CoarseCapacity, holds_the_items_in_two_steps_a_power_of_two) {
  for (std::uint64_t items = 0; items < 5000; ++items) {
    const std::uint64_t capacity = coarse_capacity(items);
    EXPECT_GE(capacity, items);
    EXPECT_LE(capacity, items + items / 2 + 1);
    EXPECT_EQ(coarse_capacity(capacity), capacity);
  }
  EXPECT_EQ(coarse_capacity(1025), 1536u);
  EXPECT_EQ(coarse_capacity(1536), 1536u);
  EXPECT_EQ(coarse_capacity(1537), 2048u);
}

}  // namespace
}  // namespace gloam
