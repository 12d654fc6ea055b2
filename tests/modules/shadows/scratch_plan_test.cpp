// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/scratch_plan.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace gloam {
namespace {

/// Every item once, inside its batch's square, at a multiple of its size, over no other.
void expect_sound(const ScratchPlan& plan, const std::vector<std::uint32_t>& sizes) {
  std::vector<int> seen(sizes.size());
  for (const ScratchPlan::Batch& batch : plan.batches) {
    ASSERT_LE(batch.side, plan.side);
    constexpr std::uint32_t kCell = 16;
    const std::uint32_t cells = batch.side / kCell;
    std::vector<std::uint8_t> taken(std::size_t{cells} * cells);
    for (const ScratchPlan::Place& place : batch.places) {
      const std::uint32_t size = sizes[place.item];
      ++seen[place.item];
      EXPECT_EQ(place.corner.x % size, 0u);
      EXPECT_EQ(place.corner.y % size, 0u);
      ASSERT_LE(place.corner.x + size, batch.side);
      ASSERT_LE(place.corner.y + size, batch.side);
      for (std::uint32_t y = place.corner.y / kCell; y < (place.corner.y + size) / kCell; ++y)
        for (std::uint32_t x = place.corner.x / kCell; x < (place.corner.x + size) / kCell; ++x) {
          EXPECT_EQ(taken[y * cells + x], 0);
          taken[y * cells + x] = 1;
        }
    }
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
}

TEST(ScratchPlan, places_every_face_once_without_overlap) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::uint32_t> sizes;
    for (std::uint32_t i = 0; i < random() % 200; ++i) sizes.push_back(16u << random() % 8);
    expect_sound(plan_scratch(sizes), sizes);
  }
}

TEST(ScratchPlan, nothing_takes_no_batch) { EXPECT_TRUE(plan_scratch({}).batches.empty()); }

TEST(ScratchPlan, one_small_face_uses_a_small_square) {
  const ScratchPlan plan = plan_scratch(std::vector<std::uint32_t>{64});
  ASSERT_EQ(plan.batches.size(), 1u);
  EXPECT_EQ(plan.batches[0].side, 64u);
  EXPECT_EQ(plan.side, kScratchSide);
}

TEST(ScratchPlan, sixteen_faces_of_512_fill_one_batch_and_the_next_begins_another) {
  EXPECT_EQ(plan_scratch(std::vector<std::uint32_t>(16, 512)).batches.size(), 1u);
  EXPECT_EQ(plan_scratch(std::vector<std::uint32_t>(17, 512)).batches.size(), 2u);
}

TEST(ScratchPlan, grows_with_a_face_that_is_larger) {
  const std::vector<std::uint32_t> sizes = {16, 4096, 512};
  const ScratchPlan plan = plan_scratch(sizes);
  EXPECT_EQ(plan.side, 4096u);
  expect_sound(plan, sizes);
}

}  // namespace
}  // namespace gloam
