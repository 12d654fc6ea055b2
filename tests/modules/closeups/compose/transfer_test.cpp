// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/compose/transfer.h"

#include <gtest/gtest.h>

#include <cmath>

#include "modules/shadows/atlas/face_regions.h"
#include "tests/modules/closeups/compose/transfer_cases.h"

namespace gloam {
namespace {

TEST(CloseupTransfer, fifteen_by_thirty_seven_texels_are_read_at_level_three) {
  EXPECT_EQ(transfer_level(vec2(15.0f, 37.0f), 2048), 3u);
  EXPECT_EQ(transfer_level(vec2(37.0f, 15.0f), 2048), 3u);
}

TEST(CloseupTransfer, the_level_is_the_finest_with_two_texels_across_the_smaller_side) {
  for (std::uint32_t smaller = 1; smaller <= 2048; ++smaller) {
    std::uint32_t level = 0;
    while ((smaller + (1u << level) - 1) >> level > 2) ++level;
    EXPECT_EQ(transfer_level(vec2(smaller, 3 * smaller), 2048), level) << smaller;
  }
  EXPECT_EQ(transfer_level(vec2(0.01f, 0.02f), 64), 0u);
  EXPECT_EQ(transfer_level(vec2(1e9f, 1e9f), 64), 5u) << "two texels of the whole map";
}

/// The value of a row at (x, y, 1).
double at(const vec3& row, double x, double y) { return glm::dot(dvec3(row), dvec3(x, y, 1.0)); }

TEST(CloseupTransfer, points_lie_and_have_depths_where_faces_see_them) {
  test::TransferDice dice(5);
  for (int round = 0; round < 400; ++round) {
    const test::TransferCase pair = dice.pair(round % 2 == 0);
    const shaders::CloseupTransfer t = transfer_constants(pair.from, 512, pair.to, whole_face(pair.to));
    for (int i = 0; i < 20; ++i) {
      const dvec3 point = dice.seen_by(pair.from);
      const auto from = project(pair.from, point), to = project(pair.to, point);
      if (!from || !to || to->along_m < 0.2) continue;
      const double w = at(t.row_w, to->x, to->y);
      ASSERT_GT(w, 0.0);
      EXPECT_NEAR(at(t.row_u, to->x, to->y) / w, from->x, 0.02);
      EXPECT_NEAR(at(t.row_v, to->x, to->y) / w, from->y, 0.02);
      const double depth = (static_cast<double>(t.depth_scale) * from->depth + at(t.depth_row, from->x, from->y)) /
                           at(t.depth_w, from->x, from->y);
      EXPECT_NEAR(depth, to->depth, 2e-6 + 1e-5 * to->depth);
    }
  }
}

TEST(CloseupTransfer, a_face_moves_into_itself_texel_by_texel) {
  test::TransferDice dice(6);
  for (int round = 0; round < 100; ++round) {
    const test::TransferCase pair = dice.pair(round % 2 == 0);
    const shaders::CloseupTransfer t = transfer_constants(pair.to, 512, pair.to, whole_face(pair.to));
    for (const double x : {0.0, 0.3, 1.0})
      for (const double y : {0.0, 0.6, 1.0}) {
        const double side = pair.to.square.size;
        const double w = at(t.row_w, x * side, y * side);
        EXPECT_NEAR(at(t.row_u, x * side, y * side) / w, x * side, 1e-3);
        EXPECT_NEAR(at(t.row_v, x * side, y * side) / w, y * side, 1e-3);
        EXPECT_NEAR((static_cast<double>(t.depth_scale) * 0.4 + at(t.depth_row, x, y)) / at(t.depth_w, x, y), 0.4,
                    1e-5);
      }
  }
}

}  // namespace
}  // namespace gloam
