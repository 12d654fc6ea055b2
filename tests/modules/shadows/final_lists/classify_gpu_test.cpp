// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/modules/shadows/support/final_lists/classify.h"

// Classification may leave a tile and a light unknown, but any verdict must be what the filter finds for every pixel.

namespace gloam {
namespace {

using ClassifyShadows = test::ClassifyShadowsTest;
using Way = test::ClassifyWay;
struct ClassifyMaps : test::ClassifyShadowsWays {};

// Hard case: selftest.classification
TEST_P(ClassifyMaps, never_contradict_the_filter) { run(); }

INSTANTIATE_TEST_SUITE_P(
    Of, ClassifyMaps,
    ::testing::Values(Way{"standard", {}, 40}, Way{"larger_pictures", {}, 10, {160, 120}},
                      Way{"nearest", {{"shadows.mip_operator", "nearest"}}, 12, {64, 48}, true},
                      Way{"average", {{"shadows.mip_operator", "average"}}}, Way{"no_bias", {{"shadows.bias_mm", "0"}}},
                      Way{"large_bias", {{"shadows.bias_mm", "20"}}, 12, {64, 48}, true},
                      Way{"terminator", {{"shadows.terminator", "on"}}, 10, {200, 152}, false, {5, 4}},
                      Way{"terminator_close", {{"shadows.terminator", "on"}}, 12, {200, 152}, true, {5, 4}},
                      Way{"d16", {{"shadows.depth", "d16"}}, 12, {64, 48}, true},
                      Way{"coarse_maps", {{"shadows.texels_per_pixel", "0.25"}, {"shadows.visibility_bits", "4"}}}),
    test::name_of_way);

TEST_F(ClassifyShadows, an_empty_room_is_lit_at_once_and_the_floor_below_a_table_is_not) {
  put_room();
  put_light(point(0.05f), dvec3(0.2, 1.6, 0.5), dvec3(0.0, -1.0, 0.0), 256);
  settings = test::look_at(dvec3(0.0, 1.4, 2.5), dvec3(0.0, 0.6, -1.0), 64, 48);
  ASSERT_NO_FATAL_FAILURE(expect_no_contradiction("room"));
  EXPECT_GT(lit * 2, candidates) << "nothing stands in most of the light";
  // A table above the whole floor.
  lit = unlit = candidates = 0;
  settings = test::look_at(dvec3(0.0, 0.7, 2.5), dvec3(0.0, 0.0, -0.5), 64, 48);
  put(shapes_[0], glm::scale(at(0.2, 1.1, 0.5), dvec3(2.5, 0.02, 2.5)));
  ASSERT_NO_FATAL_FAILURE(expect_no_contradiction("table"));
  EXPECT_GT(unlit * 4, candidates) << "no light reaches the floor";
}

}  // namespace
}  // namespace gloam
