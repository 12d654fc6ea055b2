// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <random>
#include <vector>

#include "modules/shadows/atlas/placement.h"

namespace gloam {
namespace {

bool overlap(const AtlasSquare& a, const AtlasSquare& b) {
  return a.origin.x < b.origin.x + b.size && b.origin.x < a.origin.x + a.size && a.origin.y < b.origin.y + b.size &&
         b.origin.y < a.origin.y + a.size;
}

void expect_sound(const std::vector<AtlasSquare>& squares, std::uint32_t side) {
  for (std::size_t i = 0; i < squares.size(); ++i) {
    const AtlasSquare& s = squares[i];
    EXPECT_EQ(s.origin % s.size, uvec2(0));
    EXPECT_LE(std::max(s.origin.x, s.origin.y) + s.size, side);
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(overlap(s, squares[j])) << i << " and " << j;
  }
}

FaceRequest request(std::uint32_t light, std::uint32_t size) { return {{Entity{light, 1}, 0}, size, 1.0f}; }

TEST(FreeSquares, an_empty_atlas_is_one_square) {
  FreeSquares free(256, {});
  EXPECT_EQ(free.take(256), (AtlasSquare{uvec2(0), 256}));
  EXPECT_EQ(free.take(16).size, 0u);
}

TEST(FreeSquares, an_atlas_that_has_placed_nothing_has_none) {
  EXPECT_EQ(ShadowAtlas().free_squares().take(16).size, 0u);
}

TEST(FreeSquares, squares_come_out_of_the_smallest_place_that_holds_them) {
  const std::vector<AtlasSquare> taken = {{uvec2(0), 64}, {uvec2(64, 0), 32}, {uvec2(128, 128), 128}};
  FreeSquares free(256, taken);
  const AtlasSquare small = free.take(32);
  EXPECT_TRUE(overlap(small, {uvec2(64, 0), 64})) << "beside the small one";
  EXPECT_EQ(free.take(128).size, 128u);
  EXPECT_EQ(free.take(128).size, 128u);
  EXPECT_EQ(free.take(128).size, 0u);
  EXPECT_EQ(free.take(64).size, 64u);
  EXPECT_EQ(free.take(64).size, 64u);
  EXPECT_EQ(free.take(64).size, 0u);
}

TEST(FreeSquares, looking_places_nothing) {
  ShadowAtlas atlas;
  const std::vector<FaceRequest> requests = {request(1, 64), request(2, 32)};
  const FacePlaces before = atlas.place(256, requests);
  FreeSquares free = atlas.free_squares();
  EXPECT_EQ(free.take(128).size, 128u);
  EXPECT_EQ(atlas.used_texels(), 64u * 64u + 32u * 32u);
  EXPECT_EQ(atlas.place(256, requests).squares, before.squares);
  EXPECT_EQ(atlas.free_squares().take(128).size, 128u);
}

TEST(FreeSquares, whatever_lies_there_all_that_is_left_can_be_taken) {
  std::mt19937 random(7);
  for (int round = 0; round < 200; ++round) {
    ShadowAtlas atlas;
    std::vector<FaceRequest> requests;
    for (std::uint32_t i = 0; i < random() % 40; ++i) requests.push_back(request(i + 1, 16u << random() % 4));
    const FacePlaces places = atlas.place(256, requests);
    std::vector<AtlasSquare> squares;
    for (const AtlasSquare& square : places.squares)
      if (square.size > 0) squares.push_back(square);
    FreeSquares free = atlas.free_squares();
    for (int i = 0; i < 30; ++i)
      if (const AtlasSquare found = free.take(16u << random() % 5); found.size > 0) squares.push_back(found);
    for (AtlasSquare found = free.take(16); found.size > 0; found = free.take(16)) squares.push_back(found);
    std::uint64_t texels = 0;
    for (const AtlasSquare& square : squares) texels += std::uint64_t{square.size} * square.size;
    EXPECT_EQ(texels, 256u * 256u);
    expect_sound(squares, 256);
  }
}

}  // namespace
}  // namespace gloam
