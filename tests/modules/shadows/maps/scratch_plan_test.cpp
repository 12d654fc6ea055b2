// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/maps/scratch_plan.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace gloam {
namespace {

TEST(ScratchPlan, gives_every_face_a_layer_of_its_size) {
  std::mt19937 random(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<std::uint32_t> sizes;
    for (std::uint32_t i = 0; i < random() % 400; ++i) sizes.push_back(16u << random() % 9);
    std::vector<int> seen(sizes.size());
    const ScratchPlan plan = plan_scratch(sizes);
    for (const ScratchPlan::Batch& batch : plan.batches) {
      const std::size_t layers = batch.items.size(), texels = layers * batch.size * batch.size;
      EXPECT_TRUE(layers > 0 && layers <= kMostScratchLayers);
      EXPECT_TRUE(layers == 1 || texels <= kScratchTexels);
      EXPECT_LE(texels, plan.texels());
      for (const std::uint32_t item : batch.items) {
        EXPECT_EQ(sizes[item], batch.size);
        ++seen[item];
      }
    }
    for (const int count : seen) EXPECT_EQ(count, 1);
  }
}

TEST(ScratchPlan, nothing_takes_no_batch) {
  EXPECT_TRUE(plan_scratch({}).batches.empty());
  EXPECT_EQ(plan_scratch({}).texels(), 0u);
}

TEST(ScratchPlan, four_faces_of_512_fill_one_batch_and_the_next_begins_another) {
  EXPECT_EQ(plan_scratch(std::vector<std::uint32_t>(4, 512)).batches.size(), 1u);
  EXPECT_EQ(plan_scratch(std::vector<std::uint32_t>(5, 512)).batches.size(), 2u);
}

TEST(ScratchPlan, batches_may_be_larger_than_those_of_standard_maps) {
  const std::vector<std::uint32_t> sizes(4, 1024);
  EXPECT_EQ(plan_scratch(sizes).batches.size(), 4u);
  EXPECT_EQ(plan_scratch(sizes, 4 * 1024 * 1024).batches.size(), 1u);
}

TEST(ScratchPlan, the_largest_face_has_an_image_of_its_own) {
  const ScratchPlan plan = plan_scratch(std::vector<std::uint32_t>{16, 4096, 4096});
  ASSERT_EQ(plan.batches.size(), 3u);
  EXPECT_EQ(plan.batches[0].items.size(), 1u);
  EXPECT_EQ(plan.texels(), 4096u * 4096u);
  EXPECT_EQ(plan.batches[0].size, 4096u);
}

}  // namespace
}  // namespace gloam
