// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/support/final_lists/deferred_scene.h"

// shadows.mode=deferred draws the same picture as monolithic: all picture sizes, kinds and numbers of lights.

namespace gloam {
namespace {

using test::Dice;
using test::ReadFinalLists;
using DeferredShadowsCases = test::DeferredShadowsTest;

// Hard case: shadows.size_1x1, shadows.size_7x5, shadows.size_33x31
TEST_F(DeferredShadowsCases, of_pictures_smaller_than_a_tile_and_of_odd_sizes_are_the_same) {
  put_pillars();
  put_three_lights();
  for (const uvec2 size : {uvec2(1, 1), uvec2(7, 5), uvec2(33, 31), uvec2(65, 9)}) {
    settings.width = size.x;
    settings.height = size.y;
    expect_deferred_is_monolithic(std::to_string(size.x) + "x" + std::to_string(size.y));
    const ReadFinalLists found = lists();
    EXPECT_EQ(found.tiles, (size + 7u) / 8u);
  }
}

// Hard case: shadows.lights_0, shadows.lights_1, shadows.lights_31, shadows.lights_32, shadows.lights_33
// Hard case: shadows.one_place
TEST_F(DeferredShadowsCases, of_any_number_of_lights_in_one_place_are_the_same) {
  put_pillars();
  int there = 0;
  for (const int count : {0, 1, 2, 31, 32, 33}) {
    for (; there < count; ++there) {
      Light made = there % 2 == 0 ? point(0.05f) : spot(50.0, 0.1f);
      made.intensity = 0.4f;
      put_light(made, dvec3(0.2, 1.5, 0.4), dvec3(0.0, -1.0, -0.3), 32);
    }
    const Drawn drawn = expect_deferred_is_monolithic(std::to_string(count) + " lights");
    EXPECT_TRUE(count == 0 || !is_one_color(drawn.picture));
  }
  EXPECT_EQ(lists().local.size(), 33u);
}

TEST_F(DeferredShadowsCases, of_directional_lights_alone_and_of_lights_without_shadows_are_the_same) {
  put_pillars();
  Dice dice(4);
  put_suns(dice, 1);
  Light made = sun(0.02f);
  made.intensity = 0.7f;
  put_light(made, dvec3(0.0), dvec3(0.3, -1.0, -0.5), 256);
  expect_deferred_is_monolithic("suns");
  EXPECT_GT(lists().counters.slots, 0u);
  made.intensity = 0.2f;
  for (int i = 0; i < 14; ++i) put_light(made, dvec3(0.0), dice.direction() - dvec3(0.0, 1.1, 0.0), 64, i % 3 != 0);
  expect_deferred_is_monolithic("16 suns");
  clear_scene();
  put_pillars();
  const Entity only = put_light(point(0.05f), dvec3(0.4, 1.2, 1.1));
  for (int i = 0; i < 5; ++i)
    put_light(random_light(dice), dvec3(0.3 * i - 1.0, 1.0, 0.9), dvec3(0.0, -1.0, -0.5), 64, false);
  expect_deferred_is_monolithic("one of six casts");
  const ReadFinalLists found = lists();
  EXPECT_GT(found.counters.unshadowed, 0u);
  world.get<ShadowCaster>(only).enabled = false;
  expect_deferred_is_monolithic("none casts");
}

}  // namespace
}  // namespace gloam
