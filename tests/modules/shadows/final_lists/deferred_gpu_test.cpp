// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/support/final_lists/deferred_scene.h"

// shadows.mode=deferred draws the same picture as monolithic.

namespace gloam {
namespace {

using test::Dice;
using test::ReadFinalLists;
using DeferredShadows = test::DeferredShadowsTest;

// Hard case: selftest.deferred_monolithic
TEST_F(DeferredShadows, of_random_scenes_are_the_same) {
  const int count = test::scaled(50);
  for (int seed = 0; seed < count && !HasFailure(); ++seed) {
    random_scene(static_cast<std::uint32_t>(seed) + 1000u, 40u + static_cast<std::uint32_t>(seed) * 7u % 50u, 48);
    if (seed % 2 == 0) put_glass();
    expect_deferred_is_monolithic("seed " + std::to_string(seed));
  }
}

TEST_F(DeferredShadows, of_4_bits_and_without_classification_are_the_same) {
  for (const char* classify : {"on", "off"})
    for (const char* bits : {"4", "8", "exact"}) {
      set("shadows.classify", classify);
      set("shadows.visibility_bits", bits);
      for (std::uint32_t seed = 0; seed < 5 && !HasFailure(); ++seed) {
        random_scene(seed + 50);
        expect_deferred_is_monolithic(std::string(bits) + " bits, seed " + std::to_string(seed));
      }
      EXPECT_EQ(lists().frames, std::string_view(bits) == "exact" ? 0u : 1u);
    }
}

TEST_F(DeferredShadows, have_lists_and_shadows_to_compare) {
  put_pillars();
  put_three_lights();
  const Drawn with = expect_deferred_is_monolithic("pillars");
  EXPECT_FALSE(is_one_color(with.picture));
  EXPECT_NE(frame("off").picture.rgba, with.picture.rgba);
  set("shadows.mode", "deferred");
  const ReadFinalLists found = lists();
  ASSERT_EQ(found.frames, 1u);
  EXPECT_GT(found.counters.slots, 10u);
  EXPECT_EQ(counter("shadows.slots"), found.counters.slots);
  EXPECT_TRUE(found.always_complete);
  EXPECT_EQ(found.bits, 8u);
}

TEST_F(DeferredShadows, where_early_lists_find_no_room_are_the_same) {
  put_pillars();
  put_glass();
  Dice dice(8);
  put_lights(dice, 9);
  put_suns(dice, 1);
  set("lights.fixed_slots", "3");
  expect_deferred_is_monolithic("fixed slots");
  const ReadFinalLists found = lists();
  EXPECT_GT(found.counters.fallback_tiles, 0u);
  EXPECT_EQ(found.fallback_tiles.size(), found.counters.fallback_tiles);
  EXPECT_LT(found.counters.fallback_tiles, found.texels.size()) << "some tiles have no more than three lights";
  EXPECT_FALSE(found.always_complete);
}

TEST_F(DeferredShadows, by_brute_force_over_lights_are_the_same) {
  put_pillars();
  put_three_lights();
  const Drawn tiled = expect_deferred_is_monolithic("tiled");
  set("lights.culling", "brute");
  expect_same(expect_deferred_is_monolithic("brute"), tiled, "brute and tiled");
}

TEST_F(DeferredShadows, of_two_views_are_the_same_as_of_each_alone) {
  put_pillars();
  put_glass();
  put_three_lights();
  ViewRequest views[] = {{settings, {}}, {test::look_at(dvec3(-1.8, 1.5, 2.0), dvec3(0.2, 0.2, 0.0), 70, 81), {}}};
  views[1].settings.id = ViewId{1};
  set("shadows.mode", "deferred");
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(renderer->render(world, views).ok());
    ASSERT_TRUE(renderer->wait().ok());
  }
  const Drawn first{linear(0), picture(0)}, second{linear(1), picture(1)};
  expect_same(first, frame("monolithic"), "first view");
  settings = views[1].settings;
  expect_same(second, frame("monolithic"), "second view");
}

}  // namespace
}  // namespace gloam
