// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/support/final_lists/deferred_scene.h"

// shadows.mode=deferred draws the same picture as monolithic, however small the buffers are.

namespace gloam {
namespace {

using test::Dice;
using test::ReadFinalLists;
using DeferredShadows = test::DeferredShadowsTest;

/// Buffers for a share of what a frame without limits asks for.
class DeferredShadowsLimits : public DeferredShadows, public ::testing::WithParamInterface<const char*> {};

// Hard case: shadows.full_slots, shadows.full_visibility
TEST_P(DeferredShadowsLimits, change_no_picture_at_any_share_of_the_need) {
  const std::string bits = GetParam();
  set("shadows.visibility_bits", bits);
  for (const std::uint32_t seed : bits == "8" ? std::vector{0u, 1u, 2u} : std::vector{2u}) {
    clear_scene();
    put_pillars();
    put_glass();
    put_three_lights();
    if (seed == 1) put_cookies(2);
    if (seed == 2) {
      Dice dice(21);
      put_lights(dice, 8);
    }
    const Drawn monolithic = frame("monolithic");
    expect_same(frame("deferred"), monolithic, "unlimited");
    const double slots = counter("shadows.slots"), pairs = counter("shadows.tile_lights_filtered");
    ASSERT_GT(slots, 20.0);
    ASSERT_EQ(counter("shadows.fallback_tiles"), 0.0);
    for (const auto& [knob, need] : {std::pair("shadows.slot_limit", slots), std::pair("shadows.pair_limit", pairs)}) {
      double least = 1e9;
      for (const double share : {0.0, 0.5, 0.99}) {
        const std::string what =
            bits + " bits, scene " + std::to_string(seed) + ", " + knob + " " + std::to_string(share);
        set(knob, std::to_string(static_cast<int>(need * share)));
        expect_same(frame("deferred"), monolithic, what);
        EXPECT_GT(counter("shadows.fallback_tiles"), 0.0) << what;
        EXPECT_LE(counter("shadows.fallback_tiles"), least) << what;
        least = counter("shadows.fallback_tiles");
        const ReadFinalLists found = lists();
        EXPECT_EQ(found.counters.fallback_tiles, found.fallback_tiles.size()) << what;
        for (const std::uint32_t tile : found.fallback_tiles)
          EXPECT_FALSE(found.complete((tile >> 16) * found.tiles.x + (tile & 0xFFFFu))) << what;
      }
      EXPECT_LT(least, 48.0) << "nearly all that is needed leaves tiles with lists";
      set(knob, std::to_string(static_cast<int>(need)));
      expect_same(frame("deferred"), monolithic, "just enough");
      EXPECT_EQ(counter("shadows.fallback_tiles"), 0.0) << knob;
      set(knob, "4194301");
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bits, DeferredShadowsLimits, ::testing::Values("8", "4"));

}  // namespace
}  // namespace gloam
