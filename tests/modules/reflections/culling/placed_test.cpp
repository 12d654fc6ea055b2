// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/culling/placed.h"

#include <gtest/gtest.h>

#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <utility>

namespace gloam {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr float kNaNf = std::numeric_limits<float>::quiet_NaN();

PlacedProxy must_place(vec2 size, const dmat4& matrix) {
  PlacedProxy placed;
  IbrProxy proxy;
  proxy.size_m = size;
  EXPECT_EQ(place_proxy({7, 1}, proxy, matrix, placed), ProxyPlacement::placed);
  return placed;
}

ProxyPlacement placement(vec2 size, const dmat4& matrix) {
  PlacedProxy placed;
  IbrProxy proxy;
  proxy.size_m = size;
  return place_proxy({7, 1}, proxy, matrix, placed);
}

TEST(PlacedProxies, have_the_corners_of_the_scaled_rectangle_and_face_local_z) {
  dmat4 matrix = glm::translate(dmat4(1.0), dvec3(10.0, 2.0, -3.0));
  matrix = glm::rotate(matrix, 1.5707963267948966, dvec3(0.0, 1.0, 0.0));  // local +Z is world +X
  matrix = glm::scale(matrix, dvec3(2.0, 3.0, 5.0));
  const PlacedProxy placed = must_place({4.0f, 2.0f}, matrix);
  EXPECT_EQ(placed.entity.index, 7u);
  EXPECT_LT(glm::length(placed.normal - dvec3(1.0, 0.0, 0.0)), 1e-12);
  for (const dvec3& corner : placed.corners()) {
    EXPECT_NEAR(corner.x, 10.0, 1e-12);
    EXPECT_NEAR(std::abs(corner.y - 2.0), 3.0, 1e-12);
    EXPECT_NEAR(std::abs(corner.z + 3.0), 4.0, 1e-12);
  }
}

TEST(PlacedProxies, keep_their_side_under_mirrored_scales) {
  for (const dvec3& scale : {dvec3(1, 1, -1), dvec3(-1, 1, 1), dvec3(1, -1, -1), dvec3(-1, -1, 1)}) {
    const dmat4 matrix = glm::scale(dmat4(1.0), scale);
    const PlacedProxy placed = must_place({1.0f, 1.0f}, matrix);
    EXPECT_NEAR(placed.normal.z, scale.z, 1e-12);
  }
}

// Hard case: reflections.no_area
TEST(PlacedProxies, without_area_are_recognised) {
  EXPECT_EQ(placement({0.0f, 1.0f}, dmat4(1.0)), ProxyPlacement::no_area);
  EXPECT_EQ(placement({1.0f, 0.0f}, dmat4(1.0)), ProxyPlacement::no_area);
  EXPECT_EQ(placement({-1.0f, -1.0f}, dmat4(1.0)), ProxyPlacement::no_area);
  EXPECT_EQ(placement({1.0f, 1.0f}, glm::scale(dmat4(1.0), dvec3(1.0, 0.0, 1.0))), ProxyPlacement::no_area);
  dmat4 collapsed(1.0);
  collapsed[1] = collapsed[0] * 2.0;
  EXPECT_EQ(placement({1.0f, 1.0f}, collapsed), ProxyPlacement::no_area);
  EXPECT_EQ(placement({1e-6f, 1e-6f}, dmat4(1.0)), ProxyPlacement::placed) << "the smallest size of the scene key";
  EXPECT_EQ(placement({1e6f, 1e-6f}, dmat4(1.0)), ProxyPlacement::placed);
}

TEST(PlacedProxies, with_NaN_or_infinity_anywhere_are_recognised) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row) {
      for (const double bad : {kNaN, std::numeric_limits<double>::infinity()}) {
        dmat4 matrix(1.0);
        matrix[column][row] = bad;
        EXPECT_EQ(placement({1.0f, 1.0f}, matrix), ProxyPlacement::not_finite) << column << ", " << row;
      }
    }
  }
  EXPECT_EQ(placement({kNaNf, 1.0f}, dmat4(1.0)), ProxyPlacement::not_finite);
  EXPECT_EQ(placement({1.0f, std::numeric_limits<float>::infinity()}, dmat4(1.0)), ProxyPlacement::not_finite);
  EXPECT_EQ(placement({1.0f, 1.0f}, dmat4(1e300)), ProxyPlacement::not_finite) << "its area overflows";
}

TEST(PlacedRooms, have_the_floor_of_their_lowest_corner_and_sorted_finite_heights) {
  PlacedRoom placed;
  IbrRoom room;
  room.size_m = vec3(2.0f, 4.0f, 6.0f);
  ReflectingHeights heights;
  heights.count = 9;  // more than there are
  heights.heights_m = {3.0f, kNaNf, -1.0f, 2.0f};
  ASSERT_TRUE(place_room({3, 1}, room, &heights, glm::translate(dmat4(1.0), dvec3(0.0, 10.0, 0.0)), placed));
  EXPECT_DOUBLE_EQ(placed.floor_m, 8.0);
  EXPECT_EQ(placed.heights_m, (std::vector<double>{-1.0, 2.0, 3.0}));
  ASSERT_TRUE(place_room({3, 1}, room, nullptr, glm::rotate(dmat4(1.0), 1.5707963267948966, dvec3(0, 0, 1)), placed));
  EXPECT_NEAR(placed.floor_m, -1.0, 1e-12) << "the box lies on its side";
  EXPECT_TRUE(placed.heights_m.empty());
}

TEST(PlacedRooms, have_the_tiers_of_their_key) {
  const std::pair<IbrRoomTiers, std::pair<bool, bool>> cases[] = {{IbrRoomTiers::all, {true, true}},
                                                                  {IbrRoomTiers::ibr_cube, {false, true}},
                                                                  {IbrRoomTiers::ssr_cube, {true, false}},
                                                                  {IbrRoomTiers::cube, {false, false}}};
  for (const auto& [tiers, wanted] : cases) {
    PlacedRoom placed;
    ASSERT_TRUE(place_room({}, {.size_m = vec3(1.0f), .tiers = tiers}, nullptr, dmat4(1.0), placed));
    EXPECT_EQ(std::pair(placed.screen_space, placed.proxies), wanted);
  }
}

TEST(PlacedRooms, without_volume_or_with_NaN_are_left_out) {
  PlacedRoom placed;
  IbrRoom room;
  EXPECT_FALSE(place_room({}, room, nullptr, dmat4(1.0), placed));
  room.size_m = vec3(1.0f);
  EXPECT_TRUE(place_room({}, room, nullptr, dmat4(1.0), placed));
  EXPECT_FALSE(place_room({}, room, nullptr, glm::scale(dmat4(1.0), dvec3(1.0, 0.0, 1.0)), placed));
  dmat4 matrix(1.0);
  matrix[3].x = kNaN;
  EXPECT_FALSE(place_room({}, room, nullptr, matrix, placed));
  room.size_m.y = kNaNf;
  EXPECT_FALSE(place_room({}, room, nullptr, dmat4(1.0), placed));
}

}  // namespace
}  // namespace gloam
