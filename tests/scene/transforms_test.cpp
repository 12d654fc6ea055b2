// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/scene/transforms.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/scene/forest.h"
#include "tests/support/expect_assert.h"

namespace gloam {
namespace {

TEST(Transforms, local_matrix_scales_then_rotates_then_translates) {
  const double half = std::sqrt(0.5);
  const LocalTransform local{.translation = dvec3(10.0, 20.0, 30.0),
                             .rotation = dquat(half, 0.0, 0.0, half),  // a quarter turn about Z: X goes to Y
                             .scale = dvec3(2.0, 3.0, 4.0)};
  const dvec4 moved = local_matrix(local) * dvec4(1.0, 1.0, 1.0, 1.0);
  EXPECT_NEAR(moved.x, 10.0 - 3.0, 1e-14);
  EXPECT_NEAR(moved.y, 20.0 + 2.0, 1e-14);
  EXPECT_NEAR(moved.z, 34.0, 1e-14);
  EXPECT_EQ(moved.w, 1.0);
}

TEST(Transforms, every_row_comes_behind_its_parent_in_random_forests) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const test::Forest forest = test::random_forest(seed, 200);
    std::vector<std::uint32_t> depths = forest.depths;
    TransformLevels levels;
    build_levels(forest.parents, depths, levels);
    ASSERT_EQ(levels.order.size(), forest.parents.size());
    std::vector<std::size_t> place(levels.order.size());
    for (std::size_t i = 0; i < levels.order.size(); ++i) place[levels.order[i]] = i;
    for (std::size_t row = 0; row < forest.parents.size(); ++row) {
      if (forest.parents[row] != kNoParentRow) {
        EXPECT_LT(place[forest.parents[row]], place[row]);
      }
    }
  }
}

TEST(Transforms, worlds_equal_the_recursive_product_for_random_forests) {
  const auto executor = make_serial_executor();
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const test::Forest forest = test::random_forest(seed, 150);
    std::vector<std::uint32_t> depths = forest.depths;
    std::vector<dmat4> matrices = forest.locals;
    TransformLevels levels;
    build_levels(forest.parents, depths, levels);
    compose_worlds(levels, forest.parents, std::vector<std::uint8_t>(matrices.size(), 1), *executor, matrices);
    for (std::uint32_t row = 0; row < matrices.size(); ++row)
      EXPECT_LT(test::relative_difference(matrices[row], test::world_by_recursion(forest, row)), 1e-12) << seed;
  }
}

TEST(Transforms, stated_depths_that_do_not_fit_are_computed_again) {
  test::Forest forest = test::random_forest(7, 100);
  std::vector<std::uint32_t> wrong(forest.parents.size());
  for (std::uint32_t i = 0; i < wrong.size(); ++i) wrong[i] = (i * 2654435761u) >> 3;
  TransformLevels levels;
  build_levels(forest.parents, wrong, levels);
  EXPECT_EQ(wrong, forest.depths);
  TransformLevels expected;
  build_levels(forest.parents, forest.depths, expected);
  EXPECT_EQ(levels.order, expected.order);
}

TEST(Transforms, a_chain_of_a_hundred_thousand_nodes_needs_no_stack) {
  const std::uint32_t count = 100'000;
  std::vector<std::uint32_t> parents(count);
  for (std::uint32_t i = 0; i < count; ++i) parents[i] = i + 1 < count ? i + 1 : kNoParentRow;
  std::vector<std::uint32_t> depths(count, 5);
  TransformLevels levels;
  build_levels(parents, depths, levels);
  EXPECT_EQ(depths.front(), count - 1);
  EXPECT_EQ(levels.order.front(), count - 1);
}

TEST(Transforms, a_cycle_asserts) {
  const std::vector<std::uint32_t> parents{1, 2, 0};
  std::vector<std::uint32_t> depths{1, 2, 3};
  TransformLevels levels;
  EXPECT_ASSERT(build_levels(parents, depths, levels), "cycle");
}

TEST(Transforms, no_rows_are_no_levels) {
  TransformLevels levels;
  build_levels({}, {}, levels);
  EXPECT_TRUE(levels.order.empty());
  const auto executor = make_serial_executor();
  mark_descendants(levels, {}, {});
  compose_worlds(levels, {}, {}, *executor, {});
}

}  // namespace
}  // namespace gloam
