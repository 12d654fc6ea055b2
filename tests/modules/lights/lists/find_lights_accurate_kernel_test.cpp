// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tests/modules/lights/lists/find_lights_kernels.h"
#include "tests/support/kernel.h"
#include "tests/support/scale.h"

namespace gloam::test {
namespace {

struct Figures {
  std::uint64_t pairs = 0;    ///< tiles with a surface, times lights
  std::uint64_t certain = 0;  ///< of those, lights that certainly reach a pixel
  std::uint64_t doubtful = 0;
};

/// Every list must be what brute force over the tile's pixels finds: ascending, a subset of the group mask, and within
/// the entries that the approximate search reserved.
Figures expect_brute_force(const SearchedScene& scene, const FoundLights& found) {
  Figures figures;
  std::uint32_t sum = 0;
  for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile) {
    sum += found.accurate_count(tile);
    if (scene.is_sky(tile)) {
      EXPECT_EQ(found.tile_lists[tile].y, 0u);
      continue;
    }
    EXPECT_LE(found.accurate_count(tile), found.approx_count(tile)) << "a pixel's light that does not touch its froxel";
    if (!found.has_list(tile)) continue;
    const std::vector<std::uint32_t> list = found.list(tile);
    EXPECT_EQ(std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()), list.end())
        << "ascending, tile " << tile;
    const std::vector<std::uint32_t> group = found.group(scene.group_of(scene.tile_at(tile)));
    EXPECT_TRUE(std::includes(group.begin(), group.end(), list.begin(), list.end())) << "tile " << tile;
    const std::vector<Reach> reach = reach_of_tile(scene, scene.tile_at(tile));
    figures.pairs += reach.size();
    for (std::uint32_t i = 0; i < reach.size(); ++i) {
      const bool listed = std::binary_search(list.begin(), list.end(), i);
      EXPECT_TRUE(listed || reach[i] != Reach::certain) << "tile " << tile << " lacks light " << i;
      EXPECT_FALSE(listed && reach[i] == Reach::none) << "tile " << tile << " lists light " << i << " for nothing";
      figures.certain += reach[i] == Reach::certain ? 1 : 0;
      figures.doubtful += reach[i] == Reach::doubtful ? 1 : 0;
    }
  }
  EXPECT_EQ(found.counters.accurate_lights, sum);
  EXPECT_EQ(found.counters.violations, 0u);
  EXPECT_EQ(found.counters.culling_errors, 0u);
  return figures;
}

class FindLightsAccurate : public KernelTest {
 protected:
  Figures run_and_expect(FindLights& kernels, const SearchedScene& scene) {
    return expect_brute_force(scene, kernels.all(scene));
  }
};

/// Sets the depth of every pixel.
void fill_depth(SearchedScene& scene, double metres) {
  std::fill(scene.depth.begin(), scene.depth.end(), scene.depth_of(metres));
}

dvec3 point_at(const SearchedScene& scene, double x, double y, double metres) {
  return scene.position_at(x * scene.view.width, y * scene.view.height, static_cast<double>(scene.depth_of(metres)));
}

// Hard case: selftest.light_lists
TEST_F(FindLightsAccurate, lists_are_those_of_brute_force_over_pixels) {
  FindLights kernels(device());
  Figures sum;
  std::uint32_t seed = 100;
  for (const uvec2 size : {uvec2(203, 117), uvec2(64, 64), uvec2(33, 31), uvec2(7, 5), uvec2(1, 1), uvec2(321, 9)}) {
    for (const bool orthographic : {false, true}) {
      SCOPED_TRACE(++seed);
      const SearchedScene scene = random_scene(
          {.width = size.x, .height = size.y, .orthographic = orthographic, .roll = 0.4 * seed}, 700, seed);
      const Figures figures = run_and_expect(kernels, scene);
      sum.certain += figures.certain;
      sum.doubtful += figures.doubtful;
    }
  }
  EXPECT_GT(sum.certain, 1000u) << "the scenes light too little to show anything";
  EXPECT_LT(sum.doubtful * 20, sum.certain) << "a band this wide shows nothing";
}

TEST_F(FindLightsAccurate, lists_do_not_depend_on_how_many_pixels_a_thread_has) {
  const SearchedScene scene = random_scene({.width = 150, .height = 90}, 900, 5);
  FoundLights first = FindLights(device()).all(scene);
  for (const std::uint32_t rows : {1u, 2u, 4u, 8u}) {
    const FoundLights found = FindLights(device(), rows).all(scene);
    for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile)
      EXPECT_EQ(found.list(tile), first.list(tile)) << rows << " rows";
    expect_brute_force(scene, found);
  }
}

TEST_F(FindLightsAccurate, lists_are_complete_in_many_small_random_scenes) {
  FindLights kernels(device());
  std::mt19937 random(77);
  Figures sum;
  for (int i = 0; i < scaled(60); ++i) {
    SCOPED_TRACE(i);
    const SceneSize size{.width = 1 + static_cast<std::uint32_t>(random() % 90),
                         .height = 1 + static_cast<std::uint32_t>(random() % 50),
                         .orthographic = random() % 4 == 0,
                         .roll = 0.001 * static_cast<double>(random() % 6283),
                         .near_m = random() % 3 == 0 ? 0.01f : 0.1f,
                         .origin = random() % 3 == 0 ? dvec3(1e5, -1e5, 1e5) : dvec3(0.0)};
    const std::uint32_t bins = 1u << random() % 11;
    const SearchedScene scene = random_scene(size, static_cast<std::uint32_t>(random() % 200),
                                             static_cast<std::uint32_t>(random()), {.z_bin_count = bins});
    const Figures figures = run_and_expect(kernels, scene);
    sum.certain += figures.certain;
    if (HasFailure()) return;
  }
  EXPECT_GT(sum.certain, 1000u);
}

// Hard case: shadows.one_place, further.lights_1024_one_point
TEST_F(FindLightsAccurate, lists_hold_any_number_of_lights_in_one_place) {
  for (const std::uint32_t rows : {0u, 1u}) {
    FindLights kernels(device(), rows);
    for (const std::uint32_t count : {0u, 1u, 31u, 32u, 33u, 1023u, 1024u}) {
      SCOPED_TRACE(count);
      std::mt19937 random(7);
      SearchedScene scene = empty_scene({.width = 20, .height = 12});
      draw_random_depth(scene, random);
      finish_scene(scene, std::vector<TestLight>(count, TestLight{.range_m = 1000.0}));  // at the camera
      const FoundLights found = kernels.all(scene);
      expect_brute_force(scene, found);
      for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile)
        EXPECT_EQ(found.accurate_count(tile), scene.is_sky(tile) ? 0u : count);
    }
  }
}

TEST_F(FindLightsAccurate, lists_hold_any_number_of_lights_that_reach_the_last_pixel_alone) {
  FindLights kernels(device());
  SearchedScene scene = empty_scene({.width = 8, .height = 8});
  for (float& depth : scene.depth) depth = scene.depth_of(3.0);
  const dvec3 last = scene.position_at(7.5, 7.5, static_cast<double>(scene.depth[63]));
  finish_scene(scene, std::vector<TestLight>(1024, TestLight{.position = last, .range_m = 0.003}));
  const FoundLights found = kernels.all(scene);
  expect_brute_force(scene, found);
  EXPECT_EQ(found.accurate_count(0), 1024u);
}

TEST_F(FindLightsAccurate, lists_know_one_pixel_beside_the_sky_and_lights_behind_it) {
  FindLights kernels(device());
  for (const std::uint32_t pixel : {0u, 7u, 27u, 36u, 56u, 63u}) {
    SearchedScene scene = empty_scene({.width = 8, .height = 8});
    scene.depth[pixel] = scene.depth_of(3.0);
    const dvec3 point = scene.position_at(pixel % 8 + 0.5, pixel / 8 + 0.5, static_cast<double>(scene.depth[pixel]));
    finish_scene(scene, {{.position = point * 1.1, .range_m = 0.35},
                         {.position = point * 1.1, .range_m = 0.25},
                         {.position = point, .range_m = 0.002}});
    const FoundLights found = kernels.all(scene);
    expect_brute_force(scene, found);
    EXPECT_EQ(found.accurate_count(0), 2u) << "pixel " << pixel;
  }
}

TEST_F(FindLightsAccurate, lists_reach_from_a_centimetre_to_a_hundred_kilometres) {
  FindLights kernels(device());
  for (const double metres : {0.011, 1.0, 300.0, 1e5}) {
    SCOPED_TRACE(metres);
    SearchedScene scene = empty_scene({.width = 64, .height = 40, .near_m = 0.01f});
    std::mt19937 random(21);
    draw_random_depth(scene, random, 0.011, 1e5);
    for (std::uint32_t y = 0; y < 16; ++y)
      for (std::uint32_t x = 0; x < 32; ++x) scene.depth[y * 64 + x] = scene.depth_of(metres);
    std::vector<TestLight> lights = random_lights(scene, 200, random);
    for (int i = 0; i < 100; ++i) {
      const double range = metres * (0.01 + 0.002 * i);
      TestLight light{.position = point_at(scene, 0.004 * i, 0.1 + 0.001 * i, metres * 1.05),
                      .range_m = range,
                      .direction = {0.1, -0.2, 1.0}};
      if (i % 2 == 0) light.outer_angle = 0.02 * i;
      lights.push_back(light);
    }
    finish_scene(scene, std::move(lights));
    EXPECT_GT(run_and_expect(kernels, scene).certain, 0u);
  }
}

TEST_F(FindLightsAccurate, lists_of_narrow_and_wide_cones_are_those_of_brute_force) {
  FindLights kernels(device());
  for (const double half_angle : {0.0, 1e-3, 0.5235988, 1.0471975, 1.0471977, 1.5, kHalfPiRadians}) {
    for (const bool hard : {false, true}) {
      SCOPED_TRACE(half_angle);
      SearchedScene scene = empty_scene({.width = 64, .height = 64});
      std::mt19937 random(9);
      std::uniform_real_distribution<double> unit(-1.0, 1.0);
      fill_depth(scene, 4.0);
      std::vector<TestLight> lights;
      for (int i = 0; i < 120; ++i) {
        const dvec3 target = point_at(scene, 0.5 + 0.5 * unit(random), 0.5 + 0.5 * unit(random), 4.0);
        const dvec3 from = glm::normalize(dvec3(unit(random), unit(random), unit(random)));
        lights.push_back(
            {.position = target + from * (1.1 + unit(random)), .range_m = 3.0, .intensity = 1e6, .direction = -from});
        lights.back().outer_angle = half_angle;
        lights.back().inner_angle = hard ? half_angle : 0.0;
      }
      finish_scene(scene, std::move(lights));
      const FoundLights found = kernels.all(scene);
      expect_brute_force(scene, found);
      EXPECT_GT(found.counters.accurate_lights, half_angle > 0.01 ? 50u : half_angle > 0.0 ? 20u : 0u);
    }
  }
}

TEST_F(FindLightsAccurate, lists_of_far_narrow_spots_keep_pixels_at_the_cones_edge) {
  FindLights kernels(device());
  for (const double away : {100.0, 1000.0, 5000.0}) {
    SCOPED_TRACE(away);
    SearchedScene scene = empty_scene({.width = 64, .height = 64});
    fill_depth(scene, 0.2);
    std::mt19937 random(9);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<TestLight> lights;
    for (int i = 0; i < 600; ++i) {
      const dvec3 target = point_at(scene, 0.5 + 0.47 * unit(random), 0.5 + 0.47 * unit(random), 0.2);
      const dvec3 from = glm::normalize(dvec3(unit(random), unit(random), unit(random)));
      const dvec3 side = glm::normalize(glm::cross(from, dvec3(0.2, 0.9, 0.1)));
      TestLight light{.range_m = 2.0 * away, .intensity = 1e6, .direction = -from};
      light.outer_angle = light.inner_angle = 0.002 + 0.05 * std::abs(unit(random));
      light.position = target + away * (from * std::cos(light.outer_angle) + side * std::sin(light.outer_angle));
      lights.push_back(light);
    }
    finish_scene(scene, std::move(lights));
    const FoundLights found = kernels.all(scene);
    expect_brute_force(scene, found);
    EXPECT_GT(found.counters.accurate_lights, 1000u);
  }
}

TEST_F(FindLightsAccurate, tiles_without_a_slot_have_a_count_and_no_list) {
  FindLights kernels(device());
  const SceneSize size{.width = 120, .height = 80};
  const FoundLights all = kernels.all(random_scene(size, 500, 31));
  const SearchedScene scene = random_scene(size, 500, 31, {.slot_capacity = all.counters.slots / 2});
  const FoundLights found = kernels.all(scene);
  ASSERT_GT(found.counters.overflow_tiles, 0u);
  expect_brute_force(scene, found);
  for (std::uint32_t tile = 0; tile < scene.tile_count(); ++tile)
    EXPECT_EQ(found.accurate_count(tile), all.accurate_count(tile));
  EXPECT_EQ(found.early_lists.back(), FoundLights::kUntouched) << "written beyond the capacity";
}

TEST_F(FindLightsAccurate, more_lights_than_entries_are_clamped_and_counted) {
  FindLights kernels(device());
  SearchedScene scene = empty_scene({.width = 16, .height = 8});
  fill_depth(scene, 2.0);
  finish_scene(scene, std::vector<TestLight>(20, TestLight{.range_m = 1000.0}));
  FoundLights found = kernels.approximate(scene);
  ASSERT_EQ(found.approx_count(0), 20u);
  found.tile_lists[0] = {30, 7u << 16};  // 9 entries: words 10 to 12
  found.tile_lists[1] = {60, 20u << 16};
  kernels.accurate(scene, found);
  EXPECT_EQ(found.accurate_count(0), 9u);
  EXPECT_EQ(found.counters.violations, 11u);
  EXPECT_EQ(found.list(0), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_EQ(found.accurate_count(1), 20u);
  EXPECT_EQ(found.early_lists[9], FoundLights::kUntouched);
  EXPECT_EQ(found.early_lists[13], FoundLights::kUntouched);
}

TEST_F(FindLightsAccurate, a_light_taken_out_of_a_list_is_found_missing) {
  FindLights kernels(device());
  const SearchedScene scene = random_scene({.width = 96, .height = 64}, 400, 41);
  const FoundLights complete = kernels.all(scene);
  ASSERT_EQ(complete.counters.culling_errors, 0u);
  int taken = 0;
  for (std::uint32_t tile = 0; tile < scene.tile_count() && taken < 5; ++tile) {
    if (complete.accurate_count(tile) < 2) continue;
    const std::uint32_t light = complete.list(tile).back();
    std::uint32_t certain = 0, doubtful = 0;
    scene.for_pixels(scene.tile_at(tile), [&](std::uint32_t x, std::uint32_t y, float depth) {
      if (depth <= 0.0f) return;
      const Reach reach =
          reach_of(scene.lights->local[light], scene.position_at(x + 0.5, y + 0.5, static_cast<double>(depth)));
      certain += reach == Reach::certain ? 1 : 0;
      doubtful += reach == Reach::doubtful ? 1 : 0;
    });
    if (certain == 0) continue;
    ++taken;
    FoundLights found = complete;
    --found.tile_lists[tile].y;
    kernels.check(scene, found);
    EXPECT_GE(found.counters.culling_errors, certain);
    EXPECT_LE(found.counters.culling_errors, certain + doubtful);

    // Without a list the group mask counts.
    found = complete;
    found.tile_lists[tile].x = GLOAM_NO_SLOT;
    kernels.check(scene, found);
    EXPECT_EQ(found.counters.culling_errors, 0u);
    found.group_masks[scene.group_of(scene.tile_at(tile)) * GLOAM_MASK_WORDS + 1 + light / 32] &= ~(1u << light % 32);
    found.counters.culling_errors = 0;
    kernels.check(scene, found);
    EXPECT_GE(found.counters.culling_errors, certain);
  }
  EXPECT_EQ(taken, 5);
}

}  // namespace
}  // namespace gloam::test
