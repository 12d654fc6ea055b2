// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "engine/jobs/executor.h"
#include "modules/lights/selection/light_list.h"
#include "tests/modules/lights/masks/mask_oracle.h"

namespace gloam {
namespace {

using test::meant_words;
using test::point_mask_light;
using test::SceneRandom;
using test::spot_mask_light;

constexpr TileBound kBounds[] = {TileBound::rect, TileBound::row_interval, TileBound::cone};

struct Lens {
  std::uint32_t width = 320;
  std::uint32_t height = 180;
  bool orthographic = false;
  double near_m = 0.1;
  double roll = 0.0;
  double off_centre = 0.0;
};

RenderView view_with(const Lens& lens) {
  ViewSettings settings;
  settings.width = lens.width;
  settings.height = lens.height;
  settings.camera.orthographic = lens.orthographic;
  settings.camera.half_height_m = 6.0f;
  settings.camera.near_m = static_cast<float>(lens.near_m);
  settings.camera.fov_y = 1.0f;
  settings.world_from_camera = glm::rotate(dmat4(1.0), lens.roll, dvec3(0.0, 0.0, 1.0));
  RenderView view = make_view(settings, 0);
  if (lens.off_centre != 0.0) test::shift_off_centre(view, lens.off_centre, -0.7 * lens.off_centre);
  return view;
}

TileLightMasks built(const std::vector<MaskLight>& lights, const RenderView& view, TileBound bound) {
  TileLightMasks masks;
  const auto executor = make_serial_executor();
  build_tile_light_masks(lights, view, bound, *executor, masks);
  return masks;
}

/// None of the three bounds may miss a light, each must find no more than the one before, and no bit may be set for a
/// light that does not exist.
void expect_right_masks(const std::vector<MaskLight>& lights, const RenderView& view, int samples = 40) {
  std::vector<std::uint32_t> before;
  for (const TileBound bound : kBounds) {
    const TileLightMasks masks = built(lights, view, bound);
    ASSERT_EQ(masks.tiles, mask_tiles_of(view.width, view.height));
    ASSERT_EQ(masks.words.size(), std::size_t{masks.tiles.x} * masks.tiles.y * GLOAM_MASK_WORDS);
    SceneRandom random(7);
    for (std::uint32_t i = 0; i < lights.size(); ++i)
      ASSERT_EQ(test::missed_tile(masks, lights[i], i, view, random, samples), "")
          << "bound " << static_cast<int>(bound);
    const std::vector<std::uint32_t> words = meant_words(masks);
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::size_t word = i % GLOAM_MASK_WORDS;
      if (word == 0) continue;
      const std::size_t first = (word - 1) * 32;
      const std::size_t count = lights.size() > first ? std::min<std::size_t>(32, lights.size() - first) : 0;
      const std::uint32_t real = count == 32 ? ~0u : (1u << count) - 1u;
      ASSERT_EQ(words[i] & ~real, 0u) << "a bit of no light in tile " << i / GLOAM_MASK_WORDS;
      const std::uint32_t more = before.empty() ? 0u : words[i] & ~before[i];
      ASSERT_EQ(more, 0u) << "bound " << static_cast<int>(bound) << " finds more";
    }
    before = words;
  }
}

/// The sum over all lights of the number of tiles that hold the light.
std::size_t bits_of(const TileLightMasks& masks) {
  std::size_t bits = 0;
  const std::vector<std::uint32_t> words = meant_words(masks);
  for (std::size_t i = 0; i < words.size(); ++i)
    if (i % GLOAM_MASK_WORDS != 0) bits += static_cast<std::size_t>(std::popcount(words[i]));
  return bits;
}

const Lens kLenses[] = {{},
                        {.width = 1, .height = 1},
                        {.width = 7, .height = 5},
                        {.width = 33, .height = 31},
                        {.width = 4095, .height = 2161},
                        {.orthographic = true},
                        {.orthographic = true, .off_centre = 0.8},
                        {.near_m = 0.01},
                        {.near_m = 5.0},
                        {.roll = 0.7},
                        {.roll = 3.0, .off_centre = 0.5},
                        {.width = 97, .height = 500, .off_centre = -1.5}};

/// Cases of a point light, and of a spot with the same position and range.
void expect_right_everywhere(const std::vector<std::pair<dvec3, double>>& places, int samples = 40) {
  std::vector<MaskLight> lights;
  for (const auto& [position, range] : places) {
    lights.push_back(point_mask_light(position, range));
    for (const double half_angle : {0.0, 0.3, 1.0471975511965976, 1.5707963267948966})
      for (const dvec3& direction :
           {dvec3(0.0, 0.0, -1.0), dvec3(0.0, 0.0, 1.0), dvec3(1.0, 0.0, 0.0), dvec3(-0.3, -0.8, -0.2)})
        lights.push_back(spot_mask_light(position, direction, half_angle, range));
  }
  for (const Lens& lens : kLenses) expect_right_masks(lights, view_with(lens), samples);
}

// Hard case: shadows.camera_inside_light
TEST(TileLightMasksHard, with_the_camera_inside_a_light_miss_nothing) {
  expect_right_everywhere(
      {{dvec3(0.0), 5.0}, {dvec3(0.5, -0.3, -0.2), 3.0}, {dvec3(0.0, 0.0, 2.9), 3.0}, {dvec3(4.0, 0.0, 0.0), 4.001}});
}

TEST(TileLightMasksHard, with_the_camera_on_a_lights_surface_miss_nothing) {
  expect_right_everywhere({{dvec3(0.0, 0.0, -4.0), 4.0},
                           {dvec3(4.0, 0.0, 0.0), 4.0},
                           {dvec3(0.0, 0.0, 4.0), 4.0},
                           {dvec3(3.0, 4.0, 0.0), 5.0}});
}

// Hard case: shadows.light_at_near_plane
TEST(TileLightMasksHard, across_the_near_plane_miss_nothing) {
  expect_right_everywhere({{dvec3(0.0, 0.0, -0.1), 0.02},
                           {dvec3(0.1, 0.05, -0.08), 0.05},
                           {dvec3(3.0, 1.0, 0.5), 1.0},
                           {dvec3(-2.0, 0.0, -4.5), 1.0},
                           {dvec3(0.0, 0.0, 0.9), 1.0},
                           {dvec3(0.0, 5.0, 4.0), 6.3}});
}

// Hard case: shadows.light_at_far_end
TEST(TileLightMasksHard, at_the_far_end_miss_nothing) {
  expect_right_everywhere({{dvec3(0.0, 0.0, -1000.0), 3.0},
                           {dvec3(20.0, 10.0, -1000.2), 1.0},
                           {dvec3(3e4, -2e4, -1e5), 10.0},
                           {dvec3(0.0, 0.0, -1e6), 1e5}});
}

// Hard case: shadows.light_behind_camera
TEST(TileLightMasksHard, behind_the_camera_are_in_no_tile) {
  const std::vector<MaskLight> lights = {point_mask_light(dvec3(0.0, 0.0, 6.0), 5.0),
                                         spot_mask_light(dvec3(1.0, 0.0, 9.0), dvec3(0.0, 0.0, -1.0), 0.5, 7.0)};
  for (const Lens& lens : kLenses) {
    expect_right_masks(lights, view_with(lens));
    for (const TileBound bound : kBounds) EXPECT_EQ(bits_of(built(lights, view_with(lens), bound)), 0u);
  }
}

TEST(TileLightMasksHard, beside_the_picture_are_in_no_tile) {
  const std::vector<MaskLight> lights = {point_mask_light(dvec3(40.0, 0.0, -10.0), 2.0),
                                         point_mask_light(dvec3(0.0, -40.0, -10.0), 2.0)};
  for (const TileBound bound : kBounds) EXPECT_EQ(bits_of(built(lights, view_with({}), bound)), 0u);
}

// Hard case: shadows.zero_radius
TEST(TileLightMasksHard, of_no_extent_are_where_the_light_is) {
  expect_right_everywhere({{dvec3(0.0, 0.0, -5.0), 0.0},
                           {dvec3(1.0, 0.4, -5.0), 1e-30},
                           {dvec3(-1.0, 0.1, -6.0), 1e-6},
                           {dvec3(0.0), 0.0}});
  EXPECT_LE(bits_of(built({point_mask_light(dvec3(0.3, 0.2, -5.0), 0.0)}, view_with({}), TileBound::row_interval)), 1u);
}

// Hard case: shadows.without_range
TEST(TileLightMasksHard, without_an_end_are_in_every_tile) {
  for (const Lens& lens : kLenses) {
    const RenderView view = view_with(lens);
    const std::size_t tiles =
        std::size_t{mask_tiles_of(view.width, view.height).x} * mask_tiles_of(view.width, view.height).y;
    for (const TileBound bound : kBounds)
      for (const double range : {1e5, 1e9})
        EXPECT_EQ(bits_of(built({point_mask_light(dvec3(7.0, -3.0, 20.0), range)}, view, bound)), tiles);
  }
}

TEST(TileLightMasksHard, at_10_metres_and_100_kilometres_miss_nothing) {
  expect_right_everywhere({{dvec3(0.0, 0.0, -1e5 - 1.0), 1e5},
                           {dvec3(1e5, 0.0, -3.0), 1e5},
                           {dvec3(0.0, 1e5, -10.0), 99999.0},
                           {dvec3(0.0, 0.0, -1e5), 99990.0}});
}

TEST(TileLightMasksHard, of_any_number_of_lights_miss_nothing) {
  for (const std::uint32_t count : {0u, 1u, 31u, 32u, 33u, 1023u, 1024u}) {
    SceneRandom random(count);
    const RenderView view = view_with({});
    std::vector<MaskLight> lights;
    for (std::uint32_t i = 0; i < count; ++i) lights.push_back(test::draw_mask_light(random, view));
    expect_right_masks(lights, view, 12);
  }
}

TEST(TileLightMasksHard, of_lights_in_one_place_hold_all_or_none_of_them) {
  const std::vector<MaskLight> lights(1024, point_mask_light(dvec3(0.7, 0.2, -6.0), 1.0));
  for (const TileBound bound : kBounds) {
    const std::vector<std::uint32_t> words = meant_words(built(lights, view_with({}), bound));
    std::size_t full = 0;
    for (std::size_t tile = 0; tile < words.size(); tile += GLOAM_MASK_WORDS) {
      full += words[tile] != 0 ? 1 : 0;
      for (std::size_t word = 1; word < GLOAM_MASK_WORDS; ++word)
        ASSERT_EQ(words[tile + word], words[tile] != 0 ? ~0u : 0u);
    }
    EXPECT_GT(full, 0u);
    EXPECT_LT(full, words.size() / GLOAM_MASK_WORDS);
  }
  expect_right_masks(lights, view_with({}), 4);
}

TEST(TileLightMasksHard, forget_the_picture_before) {
  SceneRandom random(5);
  TileLightMasks masks;
  const auto executor = make_serial_executor();
  const std::uint32_t counts[] = {1024, 0, 33, 1, 1000, 31, 64, 0};
  for (int step = 0; step < 40; ++step) {
    const RenderView view = view_with(kLenses[random.index(4)]);
    std::vector<MaskLight> lights;
    for (std::uint32_t i = 0; i < counts[step % 8]; ++i) lights.push_back(test::draw_mask_light(random, view));
    const TileBound bound = kBounds[random.index(3)];
    build_tile_light_masks(lights, view, bound, *executor, masks);
    ASSERT_EQ(meant_words(masks), meant_words(built(lights, view, bound))) << "step " << step;
  }
}

TEST(TileLightMasksHard, are_the_same_for_any_number_of_workers_in_any_order) {
  SceneRandom random(11);
  for (const Lens& lens : {Lens{}, Lens{.width = 33, .height = 31}, Lens{.width = 1920, .height = 1080}}) {
    const RenderView view = view_with(lens);
    std::vector<MaskLight> lights;
    for (int i = 0; i < 777; ++i) lights.push_back(test::draw_mask_light(random, view));
    for (const TileBound bound : kBounds) {
      const std::vector<std::uint32_t> expected = meant_words(built(lights, view, bound));
      for (int kind = 0; kind < 6; ++kind) {
        const auto executor = kind < 3 ? make_pool_executor(1u << static_cast<unsigned>(kind + kind / 2))
                                       : make_shuffled_executor(static_cast<std::uint64_t>(kind));
        TileLightMasks masks;
        build_tile_light_masks(lights, view, bound, *executor, masks);
        ASSERT_EQ(meant_words(masks), expected) << "executor " << kind;
      }
    }
  }
}

TEST(TileLightMasksHard, keep_every_other_light_when_one_is_not_a_number) {
  const RenderView view = view_with({});
  SceneRandom random(13);
  std::vector<MaskLight> lights;
  for (int i = 0; i < 40; ++i) lights.push_back(test::draw_mask_light(random, view));
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()}) {
    std::vector<MaskLight> broken = lights;
    broken[3].bounds.center.x = bad;
    broken[7].bounds.radius = bad;
    broken[31].apex.y = bad;
    broken[32].direction.z = bad;
    broken[35].cos_outer = bad;
    broken[39].bounds.center.z = bad;
    for (const TileBound bound : kBounds) {
      const TileLightMasks masks = built(broken, view, bound);
      for (std::uint32_t i = 0; i < 40; ++i) {
        if (i == 3 || i == 7 || i == 31 || i == 32 || i == 35 || i == 39) continue;
        ASSERT_EQ(test::missed_tile(masks, lights[i], i, view, random, 12), "");
      }
    }
  }
}

/// For spheres beyond the near plane: a row interval holds no tile farther than a pixel from the sphere's outline. A
/// rectangle holds no tile farther than a pixel from the outline's bounding rectangle.
// Hard case: shadows.camera_off_centre
TEST(TileLightMasksHard, hold_no_tile_farther_than_a_pixel_from_the_light) {
  int whole = 0;  // outlines inside the picture
  for (const Lens& lens :
       {Lens{}, Lens{.width = 1023, .height = 577, .roll = 0.4}, Lens{.orthographic = true, .off_centre = 0.3},
        Lens{.width = 640, .height = 360, .off_centre = 0.6}}) {
    const RenderView view = view_with(lens);
    SceneRandom random(17);
    std::vector<MaskLight> lights;
    for (int i = 0; i < 25; ++i) {
      const double depth = random.between(1.0, 30.0);
      const dvec3 in_view(random.between(-0.8, 0.8) * depth, random.between(-0.6, 0.6) * depth, -depth);
      lights.push_back(
          point_mask_light(test::relative_of_view(view, in_view), random.between(0.05, 0.8) * (depth - 0.15)));
    }
    const TileLightMasks rects = built(lights, view, TileBound::rect);
    const TileLightMasks rows = built(lights, view, TileBound::row_interval);
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
      std::vector<bool> columns(rects.tiles.x, false);
      std::vector<bool> lines(rects.tiles.y, false);
      // If the picture cuts the outline or misses it, the outline's rectangle is larger than that of the tiles it
      // touches.
      bool missed = true;
      bool cut = false;
      for (std::uint32_t y = 0; y < rects.tiles.y; ++y) {
        for (std::uint32_t x = 0; x < rects.tiles.x; ++x) {
          const bool touched = test::touches_tile(lights[i].bounds, view, {x, y}, 1.0);
          ASSERT_TRUE(touched || !test::has_light(rows, {x, y}, i)) << "light " << i << ", tile " << x << ',' << y;
          if (!touched) continue;
          columns[x] = lines[y] = true;
          missed = false;
          cut |= x == 0 || y == 0 || x + 1 == rects.tiles.x || y + 1 == rects.tiles.y;
        }
      }
      whole += cut || missed ? 0 : 1;
      for (std::uint32_t y = 0; y < rects.tiles.y && !cut && !missed; ++y)
        for (std::uint32_t x = 0; x < rects.tiles.x; ++x)
          ASSERT_TRUE((columns[x] && lines[y]) || !test::has_light(rects, {x, y}, i))
              << "light " << i << ", tile " << x << ',' << y;
    }
  }
  EXPECT_GT(whole, 10);
}

TEST(TileLightMasksHard, of_narrow_spots_find_fewer_tiles_with_each_bound) {
  const RenderView view = view_with({.width = 1920, .height = 1080});
  SceneRandom random(19);
  std::vector<MaskLight> lights;
  for (int i = 0; i < 200; ++i) {
    const double depth = random.between(3.0, 30.0);
    lights.push_back(
        spot_mask_light(dvec3(random.between(-0.8, 0.8) * depth, random.between(-0.5, 0.5) * depth, -depth),
                        random.direction(), random.between(0.1, 0.6), random.between(1.0, 5.0)));
  }
  const std::size_t rect = bits_of(built(lights, view, TileBound::rect));
  const std::size_t rows = bits_of(built(lights, view, TileBound::row_interval));
  const std::size_t cones = bits_of(built(lights, view, TileBound::cone));
  EXPECT_LT(rows, rect);
  EXPECT_LT(static_cast<double>(cones), 0.9 * static_cast<double>(rows));
}

/// For any node matrix, a light shines along the node's −Z and its bound holds what it lights.
TEST(TileLightMasksHard, of_lights_on_flat_mirrored_and_sheared_nodes_miss_nothing) {
  const RenderView view = view_with({});
  SceneRandom random(23);
  std::vector<MaskLight> lights;
  for (int i = 0; i < 300; ++i) {
    dmat4 node = test::draw_pose(
        random, dvec3(random.between(-4.0, 4.0), random.between(-3.0, 3.0), -random.between(-2.0, 12.0)));
    dmat4 shear(1.0);
    shear[1][0] = random.between(-2.0, 2.0);
    shear[2][1] = random.between(-2.0, 2.0);
    dvec3 scale(random.length(-6.0, 4.0));
    if (i % 3 == 0) scale[random.index(3)] = 0.0;
    if (i % 3 == 1) scale[random.index(3)] *= -1.0;
    if (i % 20 == 0) scale = dvec3(0.0);
    node = node * shear * glm::scale(dmat4(1.0), scale);
    Light light;
    light.kind = LightKind::spot;
    light.range_m = static_cast<float>(random.between(0.5, 5.0));
    light.outer_angle = static_cast<float>(random.between(0.0, 1.5707));
    const PlacedLight placed = place_light(Entity{static_cast<std::uint32_t>(i), 1}, light, node);
    ASSERT_NEAR(glm::length(placed.direction), 1.0f, 1e-5f);
    const dvec3 along(node[2]);
    if (glm::length(along) > 0.0) {
      ASSERT_LT(glm::length(dvec3(placed.direction) + glm::normalize(along)), 1e-5) << "light " << i;
    }
    MaskLight mask = spot_mask_light(placed.position - view.position, dvec3(placed.direction),
                                     static_cast<double>(light.outer_angle), static_cast<double>(light.range_m));
    mask.bounds = light_bounds(placed, view.position);
    lights.push_back(mask);
  }
  expect_right_masks(lights, view, 30);
}

}  // namespace
}  // namespace gloam
