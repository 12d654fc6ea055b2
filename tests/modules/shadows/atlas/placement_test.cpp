// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/atlas/placement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include "shaders/shadows/shadows_shared.h"

namespace gloam {
namespace {

FaceRequest face(std::uint32_t light, std::uint32_t index, std::uint32_t size, float importance = 1.0f) {
  return {{Entity{light, 1}, index}, size, importance};
}

/// Expects squares that are aligned, inside the atlas and not overlapping, and that no face is smaller than necessary.
void expect_sound(std::uint32_t atlas_size, std::span<const FaceRequest> requests, const FacePlaces& places) {
  ASSERT_EQ(places.squares.size(), requests.size());
  const std::uint32_t cells = atlas_size / GLOAM_SHADOW_SMALLEST_FACE;
  std::vector<int> owner(std::size_t{cells} * cells, -1);
  std::uint32_t shrunk = 0;
  std::uint32_t left_out = 0;
  for (std::size_t i = 0; i < requests.size(); ++i) {
    const AtlasSquare& s = places.squares[i];
    left_out += s.size == 0 ? 1 : 0;
    shrunk += s.size != 0 && s.size < requests[i].size ? 1 : 0;
    if (s.size == 0) continue;
    EXPECT_LE(s.size, requests[i].size);
    ASSERT_EQ(s.origin % s.size, uvec2(0));
    ASSERT_LE(std::max(s.origin.x, s.origin.y) + s.size, atlas_size);
    const uvec2 first = s.origin / std::uint32_t{GLOAM_SHADOW_SMALLEST_FACE};
    const std::uint32_t side = s.size / GLOAM_SHADOW_SMALLEST_FACE;
    for (std::uint32_t y = first.y; y < first.y + side; ++y)
      for (std::uint32_t x = first.x; x < first.x + side; ++x) {
        ASSERT_EQ(owner[y * cells + x], -1) << "faces " << i << " and " << owner[y * cells + x];
        owner[y * cells + x] = static_cast<int>(i);
      }
  }
  EXPECT_EQ(places.shrunk, shrunk);
  EXPECT_EQ(places.left_out, left_out);
}

TEST(ShadowAtlas, has_room_for_nothing) {
  ShadowAtlas atlas;
  EXPECT_TRUE(atlas.place(1024, {}).squares.empty());
  EXPECT_EQ(atlas.used_texels(), 0u);
  EXPECT_EQ(atlas.size(), 1024u);
}

TEST(ShadowAtlas, fills_up_to_the_last_texel_without_shrinking) {
  ShadowAtlas atlas;
  const std::vector<FaceRequest> requests{face(0, 0, 16),  face(1, 0, 512), face(2, 0, 512), face(3, 0, 256),
                                          face(4, 0, 256), face(5, 0, 256), face(6, 0, 128), face(7, 0, 128),
                                          face(8, 0, 128), face(9, 0, 64),  face(10, 0, 64), face(11, 0, 64),
                                          face(12, 0, 32), face(13, 0, 32), face(14, 0, 32), face(15, 0, 16),
                                          face(16, 0, 16), face(17, 0, 16), face(18, 0, 512)};
  const FacePlaces places = atlas.place(1024, requests);
  expect_sound(1024, requests, places);
  EXPECT_EQ(places.shrunk, 0u);
  EXPECT_EQ(atlas.used_texels(), 1024u * 1024u);
}

TEST(ShadowAtlas, halves_the_least_important_and_says_so) {
  ShadowAtlas atlas;
  const std::vector<FaceRequest> requests{face(0, 0, 512, 5.0f), face(1, 0, 512, 1.0f), face(2, 0, 512, 4.0f),
                                          face(3, 0, 512, 3.0f), face(4, 0, 512, 2.0f)};
  const FacePlaces places = atlas.place(1024, requests);
  expect_sound(1024, requests, places);
  EXPECT_EQ(places.squares[0].size, 512u);
  EXPECT_EQ(places.squares[1].size, 256u);
  EXPECT_EQ(places.squares[2].size, 512u);
  EXPECT_EQ(places.squares[3].size, 512u);
  EXPECT_EQ(places.squares[4].size, 256u);
  EXPECT_EQ(places.shrunk, 2u);
}

TEST(ShadowAtlas, halves_each_once_before_any_halves_again) {
  ShadowAtlas atlas;
  std::vector<FaceRequest> requests;
  for (std::uint32_t i = 0; i < 16; ++i) requests.push_back(face(i, 0, 1024, static_cast<float>(i)));
  const FacePlaces places = atlas.place(1024, requests);
  expect_sound(1024, requests, places);
  for (const AtlasSquare& square : places.squares) EXPECT_EQ(square.size, 256u);
  EXPECT_EQ(places.shrunk, 16u);
}

TEST(ShadowAtlas, halves_the_last_of_equals_first) {
  ShadowAtlas atlas;
  std::vector<FaceRequest> requests;
  for (std::uint32_t i = 0; i < 5; ++i) requests.push_back(face(i, 0, 512));
  const FacePlaces places = atlas.place(1024, requests);
  EXPECT_EQ(places.squares[0].size, 512u);
  EXPECT_EQ(places.squares[2].size, 512u);
  EXPECT_EQ(places.squares[3].size, 256u);
  EXPECT_EQ(places.squares[4].size, 256u);
}

TEST(ShadowAtlas, shrinks_a_lights_equal_faces_together) {
  ShadowAtlas atlas;
  std::vector<FaceRequest> requests;
  for (std::uint32_t i = 0; i < 6; ++i) requests.push_back(face(1, i, 512, 1.0f));
  for (std::uint32_t i = 0; i < 6; ++i) requests.push_back(face(2, i, 128, 2.0f));
  const FacePlaces places = atlas.place(1024, requests);
  expect_sound(1024, requests, places);
  for (std::uint32_t i = 0; i < 6; ++i) EXPECT_EQ(places.squares[i].size, 256u);
  for (std::uint32_t i = 6; i < 12; ++i) EXPECT_EQ(places.squares[i].size, 128u);
}

TEST(ShadowAtlas, leaves_the_least_important_out_at_the_smallest_size_a_whole_light_at_once) {
  ShadowAtlas atlas;
  std::vector<FaceRequest> requests;
  for (std::uint32_t light = 0; light < 12; ++light)
    for (std::uint32_t i = 0; i < 6; ++i) requests.push_back(face(light, i, 64, static_cast<float>((light * 7) % 12)));
  const FacePlaces places = atlas.place(128, requests);  // 64 places of 16 texels for 72 faces
  expect_sound(128, requests, places);
  EXPECT_EQ(places.left_out, 12u);
  EXPECT_EQ(places.shrunk, 60u);
  for (std::size_t i = 0; i < requests.size(); ++i)
    EXPECT_EQ(places.squares[i].size, requests[i].importance < 2.0f ? 0u : 16u);
}

TEST(ShadowAtlas, takes_faces_larger_than_itself_as_its_own_size) {
  ShadowAtlas atlas;
  const std::vector<FaceRequest> requests{face(1, 0, 4096)};
  const FacePlaces places = atlas.place(1024, requests);
  EXPECT_EQ(places.squares[0], (AtlasSquare{uvec2(0), 1024}));
  EXPECT_EQ(places.shrunk, 1u);
}

TEST(ShadowAtlas, takes_importance_that_is_no_number_for_none) {
  ShadowAtlas atlas;
  const std::vector<FaceRequest> requests{
      face(0, 0, 1024, std::numeric_limits<float>::quiet_NaN()), face(1, 0, 512, -1.0f),
      face(2, 0, 512, std::numeric_limits<float>::infinity()), face(3, 0, 512, 1.0f)};
  const FacePlaces places = atlas.place(1024, requests);
  expect_sound(1024, requests, places);
  EXPECT_EQ(places.squares[2].size, 512u);
  EXPECT_EQ(places.squares[3].size, 512u);
  EXPECT_EQ(places.squares[0].size, 512u);
  EXPECT_EQ(places.squares[1].size, 256u);
}

TEST(ShadowAtlas, keeps_squares_whatever_order_requests_come_in_and_whoever_leaves) {
  ShadowAtlas atlas;
  std::vector<FaceRequest> requests;
  for (std::uint32_t i = 0; i < 40; ++i) requests.push_back(face(i, 0, 16u << (i % 4)));
  const FacePlaces first = atlas.place(1024, requests);
  std::reverse(requests.begin(), requests.end());
  std::erase_if(requests, [](const FaceRequest& r) { return r.key.light.index % 3 == 0; });
  requests.push_back(face(100, 0, 256));
  const FacePlaces second = atlas.place(1024, requests);
  expect_sound(1024, requests, second);
  for (std::size_t i = 0; i + 1 < requests.size(); ++i)
    EXPECT_EQ(second.squares[i], first.squares[requests[i].key.light.index]);
}

TEST(ShadowAtlas, tells_generations_of_an_entity_apart) {
  ShadowAtlas atlas;
  std::vector<FaceRequest> requests{face(3, 0, 64), face(4, 0, 64)};
  const FacePlaces first = atlas.place(128, requests);
  requests[0].key.light.generation = 2;
  const FacePlaces second = atlas.place(128, requests);
  expect_sound(128, requests, second);
  EXPECT_EQ(second.squares[1], first.squares[1]);
}

TEST(ShadowAtlas, makes_room_for_a_large_face_where_the_fewest_have_to_move) {
  ShadowAtlas atlas;
  std::vector<FaceRequest> small;
  for (std::uint32_t i = 0; i < 64; ++i) small.push_back(face(i, 0, 128));
  const FacePlaces full = atlas.place(1024, small);
  // Keep one face in three of the four quarters, and two in the fourth.
  std::vector<FaceRequest> requests;
  std::array<int, 4> left{1, 2, 1, 1};
  std::vector<AtlasSquare> before;
  for (std::size_t i = 0; i < small.size(); ++i) {
    const uvec2 quarter = full.squares[i].origin / 512u;
    if (left[quarter.y * 2 + quarter.x]-- <= 0) continue;
    requests.push_back(small[i]);
    before.push_back(full.squares[i]);
  }
  ASSERT_EQ(requests.size(), 5u);
  requests.push_back(face(100, 0, 512));
  const FacePlaces places = atlas.place(1024, requests);
  expect_sound(1024, requests, places);
  EXPECT_EQ(places.shrunk, 0u);
  int moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i) moved += places.squares[i] == before[i] ? 0 : 1;
  EXPECT_EQ(moved, 1);
}

TEST(ShadowAtlas, forgets_places_with_another_size) {
  ShadowAtlas atlas;
  const std::vector<FaceRequest> requests{face(0, 0, 512), face(1, 0, 1024)};
  expect_sound(2048, requests, atlas.place(2048, requests));
  expect_sound(1024, requests, atlas.place(1024, requests));
  EXPECT_EQ(atlas.size(), 1024u);
}

TEST(ShadowAtlas, takes_six_thousand_faces) {
  ShadowAtlas atlas;
  std::vector<FaceRequest> requests;
  for (std::uint32_t light = 0; light < 1024; ++light)
    for (std::uint32_t i = 0; i < 6; ++i) requests.push_back(face(light, i, 512, static_cast<float>(light % 100)));
  const FacePlaces places = atlas.place(4096, requests);
  expect_sound(4096, requests, places);
  EXPECT_EQ(places.left_out, 0u);
  EXPECT_EQ(atlas.place(4096, requests).squares, places.squares);
  expect_sound(1024, requests, atlas.place(1024, requests));
}

TEST(ShadowAtlas, stays_sound_and_repeatable_over_random_frames) {
  ShadowAtlas atlas;
  ShadowAtlas twin;
  std::mt19937 random(3);
  for (int frame = 0; frame < 200; ++frame) {
    std::vector<FaceRequest> requests;
    for (std::uint32_t light = 0; light < 60; ++light) {
      if (random() % 4 == 0) continue;
      const std::uint32_t size = 16u << std::min(random() % 7, random() % 7);
      const auto importance = static_cast<float>(random() % 10);
      const std::uint32_t faces = light % 2 == 0 ? 6 : 1;
      for (std::uint32_t i = 0; i < faces; ++i) requests.push_back(face(light, i, size, importance));
    }
    std::shuffle(requests.begin(), requests.end(), random);
    const FacePlaces places = atlas.place(1024, requests);
    expect_sound(1024, requests, places);
    EXPECT_EQ(places.squares, twin.place(1024, requests).squares);
    std::uint64_t texels = 0;
    for (const AtlasSquare& square : places.squares) texels += std::uint64_t{square.size} * square.size;
    EXPECT_EQ(atlas.used_texels(), texels);
  }
}

TEST(ShadowAtlas, keeps_every_square_of_unchanged_requests_when_nothing_has_to_shrink_and_room_is_in_one_piece) {
  ShadowAtlas atlas;
  std::vector<FaceRequest> requests;
  std::mt19937 random(5);
  for (std::uint32_t i = 0; i < 30; ++i) requests.push_back(face(i, 0, 16u << (random() % 4)));
  FacePlaces last = atlas.place(4096, requests);
  for (std::uint32_t frame = 0; frame < 50; ++frame) {
    const std::size_t other = random() % requests.size();
    requests[other].size = 16u << (random() % 4);
    const FacePlaces now = atlas.place(4096, requests);
    for (std::size_t i = 0; i < requests.size(); ++i) {
      EXPECT_TRUE(i == other || now.squares[i] == last.squares[i]) << i;
    }
    last = now;
  }
}

std::vector<FaceRequest> requests_of(std::size_t count, std::uint32_t size) {
  std::vector<FaceRequest> requests;
  for (std::size_t i = 0; i < count; ++i) requests.push_back({{Entity{static_cast<std::uint32_t>(i), 1}}, size, 1.0f});
  return requests;
}

TEST(AtlasSide, is_the_smallest_that_holds_the_faces_up_to_the_most) {
  const auto first = [](std::size_t count, std::uint32_t size, bool spare, std::uint32_t most) {
    AtlasSide side;
    return side.next(requests_of(count, size), spare, most);
  };
  EXPECT_EQ(first(0, 0, false, 4096), AtlasSide::kLeast);
  EXPECT_EQ(first(4, 1024, false, 4096), 2048u);
  EXPECT_EQ(first(5, 1024, false, 4096), 4096u);
  EXPECT_EQ(first(1, 2048, false, 4096), 2048u);
  EXPECT_EQ(first(1000, 1024, false, 4096), 4096u);
  EXPECT_EQ(first(1, 2048, false, 1024), 1024u) << "a face larger than the atlas is shrunk";
  EXPECT_EQ(first(4, 1024, true, 4096), 4096u) << "with room for a copy of each face";
  EXPECT_EQ(first(2, 1024, true, 4096), 2048u);
}

TEST(AtlasSide, grows_at_once_and_shrinks_after_120_frames) {
  AtlasSide side;
  EXPECT_EQ(side.next(requests_of(1, 512), false, 4096), 512u);
  EXPECT_EQ(side.next(requests_of(5, 1024), false, 4096), 4096u);
  for (std::uint32_t frame = 0; frame < AtlasSide::kFramesKept; ++frame)
    ASSERT_EQ(side.next(requests_of(1, 512), false, 4096), 4096u) << frame;
  EXPECT_EQ(side.next(requests_of(1, 512), false, 4096), 512u);
  // A frame that needs the large atlas begins the wait anew.
  EXPECT_EQ(side.next(requests_of(5, 1024), false, 4096), 4096u);
  for (int frame = 0; frame < 100; ++frame) static_cast<void>(side.next(requests_of(1, 512), false, 4096));
  EXPECT_EQ(side.next(requests_of(5, 1024), false, 4096), 4096u);
  for (int frame = 0; frame < 100; ++frame) EXPECT_EQ(side.next(requests_of(1, 512), false, 4096), 4096u);
}

TEST(AtlasSide, follows_a_smaller_limit_at_once) {
  AtlasSide side;
  EXPECT_EQ(side.next(requests_of(9, 1024), false, 4096), 4096u);
  EXPECT_EQ(side.next(requests_of(9, 1024), false, 2048), 2048u);
}

}  // namespace
}  // namespace gloam
