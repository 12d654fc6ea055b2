// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/lod/residency.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace gloam {
namespace {

std::vector<VisiblePatch> patches_from(std::uint32_t first, std::uint32_t count) {
  std::vector<VisiblePatch> patches;
  for (std::uint32_t i = 0; i < count; ++i) patches.push_back({first + i, static_cast<float>(i)});
  return patches;
}

TEST(GrassResidency, no_patches_take_no_slots) {
  GrassResidency residency;
  EXPECT_TRUE(residency.place({}, 1, 1, 100).empty());
  EXPECT_EQ(residency.left_out(), 0u);
}

TEST(GrassResidency, a_patch_is_fresh_once_and_keeps_its_slot) {
  GrassResidency residency;
  const auto patches = patches_from(10, 5);
  const auto first = residency.place(patches, 1, 1, 1000);
  const auto second = residency.place(patches, 2, 1, 1000);
  ASSERT_EQ(first.size(), 5u);
  ASSERT_EQ(second.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_TRUE(first[i].fresh);
    EXPECT_TRUE(first[i].stale_rows);
    EXPECT_FALSE(second[i].fresh);
    EXPECT_FALSE(second[i].stale_rows);
    EXPECT_EQ(first[i].slot, second[i].slot);
    EXPECT_EQ(first[i].patch, patches[i].patch);
  }
}

TEST(GrassResidency, changed_rows_are_stale_but_not_fresh) {
  GrassResidency residency;
  static_cast<void>(residency.place(patches_from(0, 3), 1, 1, 1000));
  static_cast<void>(residency.place(patches_from(1, 1), 2, 2, 1000));
  for (const ResidentPatch& patch : residency.place(patches_from(0, 3), 3, 2, 1000)) {
    EXPECT_FALSE(patch.fresh);
    EXPECT_EQ(patch.stale_rows, patch.patch != 1) << patch.patch;
  }
}

TEST(GrassResidency, grows_while_slots_are_short_and_keeps_the_places) {
  GrassResidency residency;
  const auto few = residency.place(patches_from(0, 3), 1, 1, 1000);
  EXPECT_EQ(residency.capacity(), GrassResidency::kFewest);
  const auto many = residency.place(patches_from(0, 200), 2, 1, 1000);
  EXPECT_EQ(residency.capacity(), 256u);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(many[i].slot, few[i].slot);
}

TEST(GrassResidency, leaves_out_the_farthest_patches_when_nothing_is_free) {
  GrassResidency residency;
  const auto placed = residency.place(patches_from(0, 100), 1, 1, 70);
  ASSERT_EQ(placed.size(), 70u);
  EXPECT_EQ(residency.left_out(), 30u);
  for (const ResidentPatch& patch : placed) EXPECT_LT(patch.patch, 70u);
}

TEST(GrassResidency, a_second_view_of_a_frame_takes_no_slot_of_the_first) {
  GrassResidency residency;
  const auto first = residency.place(patches_from(0, 40), 5, 1, 64);
  const auto second = residency.place(patches_from(30, 40), 5, 1, 64);
  std::map<std::uint32_t, std::uint32_t> patch_of;
  for (const auto& placed : {first, second})
    for (const ResidentPatch& patch : placed) {
      const auto [at, fresh] = patch_of.emplace(patch.slot, patch.patch);
      EXPECT_EQ(at->second, patch.patch) << "slot " << patch.slot << " has two patches in one frame";
    }
  EXPECT_EQ(residency.left_out(), 6u);  // 40 + 30 wanted, 64 exist
}

TEST(GrassResidency, the_patches_unused_for_the_longest_lose_their_slots) {
  GrassResidency residency;
  static_cast<void>(residency.place(patches_from(0, 32), 1, 1, 64));
  static_cast<void>(residency.place(patches_from(32, 32), 2, 1, 64));
  static_cast<void>(residency.place(patches_from(100, 32), 3, 1, 64));  // takes those of frame 1
  for (const ResidentPatch& patch : residency.place(patches_from(32, 32), 4, 1, 64)) EXPECT_FALSE(patch.fresh);
}

TEST(GrassResidency, patches_that_are_forgotten_are_fresh_again_in_as_many_slots) {
  GrassResidency residency;
  static_cast<void>(residency.place(patches_from(0, 100), 1, 1, 1000));
  residency.clear_patches();
  EXPECT_EQ(residency.capacity(), 128u);
  const auto placed = residency.place(patches_from(50, 20), 1, 1, 1000);
  EXPECT_EQ(residency.capacity(), 128u);
  ASSERT_EQ(placed.size(), 20u);
  for (const ResidentPatch& patch : placed) EXPECT_TRUE(patch.fresh && patch.stale_rows);
}

TEST(GrassResidency, random_walks_never_share_or_lose_a_slot) {
  std::mt19937 random(7);
  GrassResidency residency;
  std::map<std::uint32_t, std::uint32_t> holds;  // slot → patch, as the fresh flags say
  for (std::uint64_t frame = 1; frame < 400; ++frame) {
    const auto patches =
        patches_from(static_cast<std::uint32_t>(random() % 300), static_cast<std::uint32_t>(random() % 120));
    std::set<std::uint32_t> used;
    for (const ResidentPatch& patch : residency.place(patches, frame, 1, 128)) {
      EXPECT_LT(patch.slot, residency.capacity());
      EXPECT_TRUE(used.insert(patch.slot).second);
      if (patch.fresh)
        holds[patch.slot] = patch.patch;
      else
        EXPECT_EQ(holds[patch.slot], patch.patch);
    }
    EXPECT_EQ(used.size() + residency.left_out(), patches.size());
    EXPECT_EQ(residency.left_out(), 0u);
  }
}

}  // namespace
}  // namespace gloam
