// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/culling/tiles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

#include "tests/jobs/executors.h"
#include "tests/modules/reflections/culling/proxy_oracle.h"
#include "tests/support/scale.h"

namespace gloam {
namespace {

constexpr double kPiD = 3.14159265358979323846;

/// Tries pixels with receivers from `lowest` up, or at the heights. Returns the hits; fails if a tile misses one.
std::uint64_t expect_no_miss(const test::ProxyScene& scene, const RenderView& view, const ProxyTileSettings& settings,
                             double lowest = 0.0, const std::vector<double>& heights = {}) {
  test::ProxyRandom random(5);
  test::HitCount count;
  const ProxyTiles tiles = test::build(scene, view, settings);
  test::try_pixels(scene, view, tiles, test::scaled(2000), lowest, heights, random, count);
  EXPECT_EQ(count.missed, 0u);
  return count.hits;
}

/// A least number of hits, at the number of pixels that are tried.
std::uint64_t least(int hits) { return static_cast<std::uint64_t>(test::scaled(hits)); }

std::uint64_t listed(const ProxyTiles& tiles) {
  std::uint64_t count = 0;
  for (const std::uint32_t word : tiles.masks) count += static_cast<std::uint64_t>(std::popcount(word));
  return count;
}

/// Upright proxies of 2×2 m along the walls of a room of 20×4×20 m, facing its middle, and lamps under the ceiling.
test::ProxyScene hall(std::uint32_t count) {
  test::ProxyScene scene;
  scene.add_room({0.0, 2.0, 0.0}, {20.0f, 4.0f, 20.0f});
  test::ProxyRandom random(3);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i % 10 == 9) {
      const double x = random.between(-8.0, 8.0);
      scene.add({x, 3.9, random.between(-8.0, 8.0)}, {0.0, -1.0, 0.0}, {1.0f, 1.0f});
      continue;
    }
    const double turn = 0.5 * kPiD * random.index(4);
    const dvec3 inward(std::cos(turn), 0.0, std::sin(turn));
    const dvec3 along(-inward.z, 0.0, inward.x);
    scene.add(-9.5 * inward + random.between(-8.0, 8.0) * along + dvec3(0.0, random.between(1.1, 2.9), 0.0), inward,
              {2.0f, 2.0f});
  }
  return scene;
}

TEST(ProxyTiles, of_a_level_camera_hold_the_columns_of_the_proxy) {
  test::ProxyScene scene;
  scene.add({1.0, 1.5, -10.0}, {0.0, 0.0, 1.0}, {2.0f, 2.0f});  // from x = 0 to 2
  const RenderView view = test::view_from({0.0, 2.0, 0.0}, 0.0, 0.0);
  ProxyTileSettings settings;
  settings.columns = 320;
  const ProxyTiles tiles = test::build(scene, view, settings);
  ASSERT_EQ(tiles.proxies, std::vector<std::uint32_t>{0});
  const double last = 0.2 * static_cast<double>(view.clip_from_view[0][0]);  // NDC of x = 2 m
  const auto last_tile = static_cast<std::uint32_t>((last + 1.0) * 8.0);
  for (std::uint32_t t = 0; t < 16; ++t)
    EXPECT_EQ(tiles.may_reflect(t, 0), t >= 7 && t <= last_tile) << t << ": 7 shares the margin of one column";
}

TEST(ProxyTiles, list_no_proxy_that_faces_away_is_behind_or_is_in_another_room) {
  test::ProxyScene scene;
  scene.add_room({0.0, 2.0, 0.0}, {40.0f, 4.0f, 40.0f});
  scene.add_room({100.0, 2.0, 0.0}, {10.0f, 4.0f, 10.0f});
  scene.add({0.0, 1.5, -10.0}, {0.0, 0.0, 1.0}, {2.0f, 2.0f});
  scene.add({0.0, 1.5, -10.0}, {0.0, 0.0, -1.0}, {2.0f, 2.0f});
  scene.add({0.0, 1.5, 10.0}, {0.0, 0.0, -1.0}, {2.0f, 2.0f});
  scene.add({100.0, 1.5, 0.0}, {-1.0, 0.0, 0.0}, {2.0f, 2.0f});
  const ProxyTiles tiles = test::build(scene, test::view_from({0.0, 2.0, 0.0}, 0.0, -0.1));
  using enum ProxyOutcome;
  EXPECT_EQ(tiles.outcomes, (std::vector<ProxyOutcome>{kept, faces_away, out_of_view, other_room}));
  EXPECT_EQ(tiles.count(kept), 1u);
  EXPECT_EQ(tiles.proxies, std::vector<std::uint32_t>{0});
  EXPECT_EQ(tiles.rooms, std::vector<std::uint32_t>{0});
}

// Hard case: reflections.straight_down
TEST(ProxyTiles, never_miss_a_hit_in_hard_views) {
  struct Case {
    const char* name;
    double pitch;
    double roll;
    float near_m;
    bool orthographic;
  };
  const Case cases[] = {{"level", 0.0, 0.0, 0.1f, false},         {"straight down", -0.5 * kPiD, 0.0, 0.1f, false},
                        {"almost down", -1.57, 0.3, 0.1f, false}, {"rolled", -0.4, 1.2, 0.1f, false},
                        {"far near", -0.7, 0.0, 1.5f, false},     {"tiny near", -0.7, 0.0, 1e-4f, false},
                        {"map", -0.5 * kPiD, 0.2, 0.1f, true},    {"isometric", -0.6, 0.0, 0.1f, true}};
  for (const Case& c : cases) {
    for (const double yaw : {0.0, 0.8, 2.5}) {
      SCOPED_TRACE(c.name);
      const RenderView view = test::view_from({1.0, 1.7, 2.0}, yaw, c.pitch, c.roll, c.near_m, c.orthographic);
      EXPECT_GT(expect_no_miss(hall(51), view, {}), least(30));
    }
  }
}

// Hard case: reflections.straight_up
TEST(ProxyTiles, are_empty_for_a_camera_that_looks_straight_up) {
  const ProxyTiles tiles = test::build(hall(50), test::view_from({1.0, 1.7, 2.0}, 0.3, 0.5 * kPiD));
  EXPECT_TRUE(tiles.proxies.empty());
  EXPECT_TRUE(tiles.masks.empty());
  EXPECT_EQ(tiles.count(ProxyOutcome::kept), 0u);
}

// Hard case: reflections.near_plane, reflections.larger_than_screen, reflections.horizontal
TEST(ProxyTiles, never_miss_a_hit_of_a_proxy_larger_than_the_screen_at_or_around_the_camera) {
  const RenderView view = test::view_from({0.0, 1.0, 0.0}, 0.2, -0.5);
  test::ProxyScene scene;
  scene.add({0.0, 2.0, -3.0}, {0.0, 0.0, 1.0}, {1000.0f, 1000.0f});
  scene.add({0.0, 5.0, 0.0}, {0.0, -1.0, 0.0}, {1000.0f, 1000.0f});  // horizontal, above the eye
  scene.add({0.0, 0.5, 0.0}, {0.0, -1.0, 0.0}, {100.0f, 100.0f});    // horizontal, below the eye
  scene.add({0.3, 1.0, 0.0}, {-1.0, 0.0, 0.0}, {10.0f, 2.0f});       // crosses the near plane
  scene.add({0.0, 1.0, -0.05}, {0.0, 0.0, 1.0}, {2.0f, 2.0f});       // nearer than the near plane
  scene.add({0.0, 1.0, 0.0}, {0.1, -0.1, 1.0}, {2.0f, 2.0f});        // through the eye
  EXPECT_GT(expect_no_miss(scene, view, {}), least(1000));
  EXPECT_GT(expect_no_miss(scene, view, {.tiles = 64, .columns = 320}), least(1000));
}

// Hard case: reflections.two_floors
TEST(ProxyTiles, never_miss_a_hit_over_two_floors) {
  // Street at 0 m, roof at 6 m; the camera on the roof sees both.
  test::ProxyScene scene;
  scene.add_room({0.0, 10.0, 0.0}, {40.0f, 20.0f, 40.0f});
  for (int i = 0; i < 12; ++i) scene.add({-11.0 + 2.0 * i, 4.0 + i % 3 * 3.0, -15.0}, {0.0, 0.0, 1.0}, {2.0f, 6.0f});
  for (const double pitch : {-0.2, -0.6, -1.2}) {
    const RenderView view = test::view_from({0.0, 7.7, 3.0}, 0.1, pitch, 0.15);
    scene.rooms[0].heights.reset();
    const ProxyTiles any = test::build(scene, view);
    EXPECT_GT(expect_no_miss(scene, view, {}), least(100));
    scene.rooms[0].heights = ReflectingHeights{{0.0f, 6.0f}, 2};
    EXPECT_GT(expect_no_miss(scene, view, {}, 0.0, {0.0, 6.0}), least(100));
    const ProxyTiles two = test::build(scene, view);
    EXPECT_LE(listed(two), listed(any)) << "stated heights narrow the bound";
  }
}

// Hard case: reflections.camera_on_room_face
TEST(ProxyTiles, never_miss_a_hit_from_a_face_of_two_rooms) {
  test::ProxyScene scene;
  scene.add_room({-5.0, 2.0, 0.0}, {10.0f, 4.0f, 20.0f});
  scene.add_room({5.0, 1.0, 0.0}, {10.0f, 6.0f, 20.0f});  // its floor is at −2 m
  scene.add_room({-5.0, 2.0, 0.0}, {10.0f, 2.0f, 10.0f});
  for (int i = 0; i < 10; ++i) scene.add({-9.0 + 2.0 * i, 2.0, -8.0}, {0.0, 0.0, 1.0}, {2.0f, 3.0f});
  const RenderView view = test::view_from({0.0, 1.7, 2.0}, 0.0, -0.4);
  EXPECT_EQ(test::build(scene, view).rooms, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_GT(expect_no_miss(scene, view, {}, -2.0), least(100));
}

// Hard case: reflections.proxies_0, reflections.proxies_1, reflections.proxies_50, reflections.proxies_51
// Hard case: reflections.proxies_500
TEST(ProxyTiles, work_for_any_number_of_proxies_tiles_and_columns) {
  for (const std::uint32_t count : {0u, 1u, 31u, 32u, 33u, 50u, 51u, 500u, 700u}) {
    for (const std::uint32_t tile_count : {1u, 4u, 8u, 16u, 32u, 64u}) {
      for (const std::uint32_t columns : {1u, 7u, 160u}) {
        const ProxyTiles tiles = test::build(hall(count), test::view_from({1.0, 1.7, 2.0}, 0.4, -0.3),
                                             {.tiles = tile_count, .columns = columns});
        EXPECT_EQ(tiles.outcomes.size(), count);
        EXPECT_EQ(tiles.proxies.size(), tiles.count(ProxyOutcome::kept));
        EXPECT_EQ(tiles.words_per_tile, (tiles.proxies.size() + 31) / 32);
        EXPECT_EQ(tiles.masks.size(), std::size_t{tile_count} * tiles.words_per_tile);
        EXPECT_TRUE(count < 31 || !tiles.proxies.empty());
        for (std::uint32_t i = 0; i < tiles.proxies.size(); ++i) {
          bool found = false;
          for (std::uint32_t t = 0; t < tile_count; ++t) found |= tiles.may_reflect(t, i);
          EXPECT_TRUE(found) << "a kept proxy is in a tile";
        }
        for (std::uint32_t t = 0; t < tile_count && tiles.words_per_tile > 0 && tiles.proxies.size() % 32 != 0; ++t)
          EXPECT_EQ(tiles.masks[(t + 1) * tiles.words_per_tile - 1] >> (tiles.proxies.size() % 32), 0u);
      }
    }
  }
}

TEST(ProxyTiles, are_equal_with_every_executor) {
  const ProxySet set = hall(500).placed();
  for (const ProxyTileBound bound : {ProxyTileBound::exact, ProxyTileBound::paper}) {
    const RenderView view = test::view_from({1.0, 1.7, 2.0}, 0.4, -0.3);
    ProxyTiles expected;
    build_proxy_tiles(set, view, {.bound = bound}, *make_serial_executor(), expected);
    for (const test::ExecutorCase& c : test::all_executors()) {
      ProxyTiles tiles;
      build_proxy_tiles(set, view, {.bound = bound}, *c.make(), tiles);
      EXPECT_EQ(tiles.proxies, expected.proxies) << c.name;
      EXPECT_EQ(tiles.outcomes, expected.outcomes) << c.name;
      EXPECT_EQ(tiles.masks, expected.masks) << c.name;
    }
  }
}

/// Mean share of the tiles that list a proxy of the room, over 64 views, and hits that the tiles miss.
struct HallMeasure {
  double share = 0.0;
  test::HitCount count;
};
HallMeasure measure_hall(ProxyTileBound bound, double pitch) {
  HallMeasure measure;
  const test::ProxyScene scene = hall(50);
  test::ProxyRandom random(9);
  for (int n = 0; n < 64; ++n) {
    const RenderView view =
        test::view_from({random.between(-8.0, 8.0), 1.7, random.between(-8.0, 8.0)}, random.between(0.0, 6.3), pitch);
    const ProxyTiles tiles = test::build(scene, view, {.bound = bound, .columns = 320});
    measure.share += static_cast<double>(listed(tiles)) / (50.0 * 16.0 * 64.0);
    test::try_pixels(scene, view, tiles, test::scaled(400), 0.0, {}, random, measure.count);
  }
  return measure;
}

TEST(ProxyTiles, list_few_proxies_in_a_hall) {
  // 50 proxies in one room, camera at 1.7 m. Without culling and tiles each share is 1.
  const double level = measure_hall(ProxyTileBound::exact, -0.1).share;
  const double down = measure_hall(ProxyTileBound::exact, -0.6).share;
  RecordProperty("level", std::to_string(level));
  RecordProperty("down", std::to_string(down));
  EXPECT_LT(level, 0.055);
  EXPECT_LT(down, 0.07);
}

TEST(ProxyTiles, of_the_paper_s_bound_miss_hits_that_the_exact_bound_lists) {
  for (const double pitch : {-0.1, -0.6, -1.2}) {
    const HallMeasure exact = measure_hall(ProxyTileBound::exact, pitch);
    const HallMeasure paper = measure_hall(ProxyTileBound::paper, pitch);
    RecordProperty("pitch_" + std::to_string(static_cast<int>(-10.0 * pitch)),
                   "exact " + std::to_string(exact.share) + ", paper " + std::to_string(paper.share) + ", missed " +
                       std::to_string(paper.count.missed) + " of " + std::to_string(paper.count.hits));
    EXPECT_EQ(exact.count.missed, 0u);
    EXPECT_GT(exact.count.hits, least(1000));
    EXPECT_GT(paper.share, exact.share) << "although it misses hits";
    EXPECT_TRUE(paper.count.missed > 0 || pitch > -0.5) << "near proxies, and floors at other heights";
    EXPECT_LT(static_cast<double>(paper.count.missed), 0.2 * static_cast<double>(paper.count.hits))
        << "the heuristic finds most hits";
  }
}

TEST(ProxyTiles, reach_at_most_one_tile_beyond_the_pixels_that_show_the_proxy) {
  const test::ProxyScene scene = hall(50);
  std::uint64_t listed_tiles = 0;
  std::uint64_t shown_tiles = 0;
  const int step_of_views = std::max(1, 12 / test::scaled(12));
  for (int n = 0; n < 12; n += step_of_views) {
    const RenderView view = test::view_from({1.0, 1.7, 2.0}, 0.5 * n, -0.1 - 0.1 * n, 0.0, 1e-3f);
    const ProxyTiles tiles = test::build(scene, view, {.columns = 320});
    for (std::uint32_t k = 0; k < tiles.proxies.size(); ++k) {
      const test::SceneProxy& proxy = scene.proxies[tiles.proxies[k]];
      std::uint64_t shown = 0;
      for (int step = 0; step < 30 * 30 * 30; ++step) {
        const dvec3 point = proxy.point(step % 30 / 29.0 - 0.5, step / 30 % 30 / 29.0 - 0.5);
        const double height = step / 900 / 29.0 * std::min(point.y, 1.7);
        if (const auto pixel = test::receiver_that_shows(view, point - view.position, height - 1.7))
          shown |= std::uint64_t{1} << proxy_tile_of(test::column_of(pixel->ndc.x, 320), 320, 16);
      }
      const std::uint64_t near_shown = shown | shown << 1 | shown >> 1;
      for (std::uint32_t t = 0; t < 16; ++t) {
        if (!tiles.may_reflect(t, k)) continue;
        ++listed_tiles;
        EXPECT_TRUE(shown == 0 || (near_shown >> t & 1) != 0) << "view " << n << ", tile " << t;
      }
      shown_tiles += static_cast<std::uint64_t>(std::popcount(shown));
    }
  }
  RecordProperty("listed", std::to_string(listed_tiles));
  RecordProperty("shown", std::to_string(shown_tiles));
  EXPECT_GE(listed_tiles, shown_tiles);
  EXPECT_LT(static_cast<double>(listed_tiles), 1.15 * static_cast<double>(shown_tiles));
}

}  // namespace
}  // namespace gloam
