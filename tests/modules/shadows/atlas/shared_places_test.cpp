// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/shared_places.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include "shaders/shadows/shadows_shared.h"

namespace gloam {
namespace {

FaceRequest request_of(std::uint32_t light, std::uint32_t index, std::uint32_t size, std::uint32_t view = 0) {
  return {{Entity{light, 1}, index, view}, size, 1.0f};
}

bool squares_overlap(const AtlasSquare& a, const AtlasSquare& b) {
  const auto apart = [](std::uint32_t a0, std::uint32_t a1, std::uint32_t b0, std::uint32_t b1) {
    return a1 <= b0 || b1 <= a0;
  };
  return !apart(a.origin.x, a.origin.x + a.size, b.origin.x, b.origin.x + b.size) &&
         !apart(a.origin.y, a.origin.y + a.size, b.origin.y, b.origin.y + b.size);
}

TEST(SharedPlaces, a_later_view_gets_the_square_of_an_earlier_one) {
  SharedPlaces places;
  const FaceRequest lamp[] = {request_of(1, 0, 64), request_of(1, 1, 64)};
  const FaceRequest larger[] = {request_of(1, 1, 256), request_of(2, 0, 128)};
  const FacePlaces first = places.place(7, 1024, lamp);
  const FacePlaces second = places.place(7, 1024, larger);
  EXPECT_EQ(second.squares[0], first.squares[1]);
  EXPECT_EQ(second.squares[1].size, 128u);
  EXPECT_EQ(second.shrunk + second.left_out, 0u);
}

TEST(SharedPlaces, cascades_of_two_views_have_squares_of_their_own) {
  SharedPlaces places;
  const FaceRequest one[] = {request_of(1, 0, 64, 3)}, two[] = {request_of(1, 0, 64, 4)};
  const FacePlaces first = places.place(0, 1024, one), second = places.place(0, 1024, two);
  EXPECT_FALSE(squares_overlap(first.squares[0], second.squares[0]));
}

TEST(SharedPlaces, the_next_frame_finds_all_faces_where_they_were) {
  SharedPlaces places;
  const FaceRequest views[3][2] = {{request_of(1, 0, 64), request_of(9, 0, 256, 1)},
                                   {request_of(2, 0, 128), request_of(9, 0, 256, 2)},
                                   {request_of(1, 0, 64), request_of(9, 0, 256, 3)}};
  std::vector<AtlasSquare> before;
  for (std::uint64_t frame = 0; frame < 4; ++frame) {
    std::vector<AtlasSquare> now;
    for (const auto& view : views)
      for (const AtlasSquare& square : places.place(frame, 1024, view).squares) now.push_back(square);
    if (frame > 0) {
      EXPECT_EQ(now, before);
    }
    before = now;
  }
}

TEST(SharedPlaces, what_finds_no_room_beside_earlier_views_is_counted) {
  SharedPlaces places;
  const FaceRequest all[] = {request_of(1, 0, 1024)}, more[] = {request_of(2, 0, 256), request_of(1, 0, 1024)};
  const FacePlaces first = places.place(0, 1024, all);
  const FacePlaces second = places.place(0, 1024, more);
  EXPECT_EQ(second.squares[0].size, 0u);
  EXPECT_EQ(second.left_out, 1u);
  EXPECT_EQ(second.squares[1], first.squares[0]);
}

TEST(SharedPlaces, faces_of_later_views_halve_until_they_fit) {
  SharedPlaces places;
  const FaceRequest first[] = {request_of(1, 0, 512), request_of(2, 0, 512), request_of(3, 0, 512)};
  const FaceRequest second[] = {request_of(4, 0, 512), request_of(5, 0, 512), request_of(1, 0, 512)};
  const FacePlaces before = places.place(0, 1024, first);
  const FacePlaces after = places.place(0, 1024, second);
  EXPECT_EQ(after.squares[0].size, 256u);
  EXPECT_EQ(after.squares[1].size, 256u);
  EXPECT_EQ(after.squares[2], before.squares[0]);
  EXPECT_EQ(after.shrunk, 2u);
  EXPECT_EQ(after.left_out, 0u);
}

TEST(SharedPlaces, faces_that_nobody_asks_for_any_more_make_room) {
  SharedPlaces places;
  const FaceRequest old[] = {request_of(1, 0, 1024)}, fresh[] = {request_of(2, 0, 1024)};
  static_cast<void>(places.place(0, 1024, old));
  EXPECT_EQ(places.place(1, 1024, fresh).squares[0].size, 1024u);
}

TEST(SharedPlaces, earlier_views_never_lose_their_squares_and_none_overlap) {
  std::mt19937 random(5);
  SharedPlaces places;
  for (std::uint64_t frame = 0; frame < 200; ++frame) {
    std::map<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>, AtlasSquare> held;
    const auto views = static_cast<std::uint32_t>(1 + random() % 5);
    for (std::uint32_t view = 1; view <= views; ++view) {
      std::vector<FaceRequest> requests;
      for (std::uint32_t light = 0; light < 12; ++light) {
        if (random() % 3 == 0) continue;
        const auto size = static_cast<std::uint32_t>(GLOAM_SHADOW_SMALLEST_FACE << random() % 5);
        for (std::uint32_t index = 0; index < (light < 4 ? 6u : 1u); ++index)
          requests.push_back(request_of(light, index, size, light > 9 ? view : 0));
      }
      const FacePlaces got = places.place(frame, 512, requests);
      ASSERT_EQ(got.squares.size(), requests.size());
      std::uint32_t left_out = 0;
      for (std::size_t i = 0; i < requests.size(); ++i) {
        const FaceKey& key = requests[i].key;
        left_out += got.squares[i].size == 0 ? 1 : 0;
        if (got.squares[i].size == 0) continue;
        const auto [at, fresh] = held.try_emplace({key.light.index, key.index, key.view}, got.squares[i]);
        ASSERT_EQ(at->second, got.squares[i]);
      }
      ASSERT_EQ(got.left_out, left_out);
      for (auto a = held.begin(); a != held.end(); ++a)
        for (auto b = std::next(a); b != held.end(); ++b) ASSERT_FALSE(squares_overlap(a->second, b->second));
    }
  }
}

}  // namespace
}  // namespace gloam
