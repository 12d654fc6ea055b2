// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/support/final_lists/deferred_scene.h"

// Buffers of deferred shadows hold all that the CPU's tile masks allow.

namespace gloam {
namespace {

using test::Dice;
using DeferredShadowsGrowth = test::DeferredShadowsTest;

TEST_F(DeferredShadowsGrowth, have_room_for_many_lights_from_the_first_frame_on) {
  put_pillars();
  Dice dice(30);
  set("shadows.filter", "hard");
  set("shadows.classify", "off");
  for (int i = 0; i < 8; ++i) {
    Light made = point(0.0f);
    made.intensity = 1.0f;
    put_light(made, dvec3(-1.4 + 0.4 * i, 1.9, 0.9), dvec3(0.0, -1.0, 0.0), 64);
  }
  for (int i = 0; i < 130; ++i) {
    Light made = point(0.0f);
    made.range_m = 0.4f;
    made.intensity = 0.2f;
    put_light(made, dice.in_box(dvec3(-1.5, 0.1, -1.5), dvec3(1.5, 0.6, 0.8)), dvec3(0.0, -1.0, 0.0), 16, false);
  }
  settings = test::look_at(dvec3(0.0, 1.4, 2.2), dvec3(0.0, 0.4, -0.5), 320, 200);
  const Drawn monolithic = frame("monolithic");
  for (int i = 0; i < 7 && !HasFailure(); ++i) {
    expect_same(frame("deferred"), monolithic, "frame " + std::to_string(i));
    EXPECT_EQ(counter("shadows.fallback_tiles"), 0.0) << "frame " << i;
  }
  EXPECT_GE(counter("shadows.slot_capacity"), counter("shadows.slots"));
  EXPECT_LE(counter("shadows.visibility_bytes"), 0.5 * counter("shadows.fixed_visibility_bytes"));
  EXPECT_EQ(counter("shadows.visibility_bytes"), 64.0 * counter("shadows.slot_capacity"));
  // A view with a different need.
  settings = test::look_at(dvec3(0.0, 2.6, 0.4), dvec3(0.0, 0.0, -0.2), 320, 200);
  const Drawn from_above = frame("monolithic");
  for (int i = 0; i < 6 && !HasFailure(); ++i) {
    expect_same(frame("deferred"), from_above, "from above");
    EXPECT_EQ(counter("shadows.fallback_tiles"), 0.0) << "from above, frame " << i;
  }
  EXPECT_GE(counter("shadows.slot_capacity"), counter("shadows.slots"));
  // Frames that are submitted without waiting for their counters.
  set("shadows.mode", "deferred");
  const ViewRequest request{settings, {}};
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(renderer->render(world, std::span(&request, 1)).ok());
  ASSERT_TRUE(renderer->wait().ok());
  expect_same({linear(), picture()}, from_above, "without waits");
}

}  // namespace
}  // namespace gloam
