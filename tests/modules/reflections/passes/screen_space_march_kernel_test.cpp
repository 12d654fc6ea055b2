// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <string>
#include <vector>

#include "tests/modules/reflections/support/trace_kernel.h"

namespace gloam::test {
namespace {

class ScreenSpaceMarch : public TraceKernelTest {};

TEST_F(ScreenSpaceMarch, hits_lie_on_the_ray_where_it_passes_behind_a_surface) {
  ProxyRandom random(1);
  std::size_t hits = 0;
  for (int i = 0; i < 12; ++i) {
    const SyntheticView seen = look(random_scene(random, 6), random_camera(random, 96, 64));
    for (const std::uint32_t scale : {1u, 2u})
      for (const bool hierarchical : {false, true}) {
        const auto c = reflection_constants(seen.view, scale);
        const Traced traced = trace(seen, c, hierarchical);
        expect_sound(seen, c, traced, "scene " + std::to_string(i) + (hierarchical ? ", hierarchical" : ", constant"));
        hits += traced.hits();
      }
  }
  EXPECT_GT(hits, 5000u);
}

TEST_F(ScreenSpaceMarch, hierarchical_march_finds_the_first_surface_behind_which_a_ray_passes) {
  ProxyRandom random(2);
  Found all;
  for (int i = 0; i < 12; ++i) {
    const SyntheticView seen = look(random_scene(random, 6), random_camera(random, 96, 64));
    const auto c = reflection_constants(seen.view, 1 + i % 2);
    const Found found = count_clear(seen, c, trace(seen, c, true));
    all.expected += found.expected;
    all.found += found.found;
    all.full += found.full;
  }
  EXPECT_GT(all.expected, 1000u);
  EXPECT_GE(all.found, all.expected * 98 / 100) << all.expected;
  EXPECT_GE(all.full, all.expected * 95 / 100) << all.expected;
}

TEST_F(ScreenSpaceMarch, hierarchical_march_finds_what_a_fine_constant_march_finds) {
  ProxyRandom random(3);
  std::size_t constant = 0, both = 0;
  for (int i = 0; i < 12; ++i) {
    const SyntheticView seen = look(random_scene(random, 8), random_camera(random, 96, 64));
    auto c = reflection_constants(seen.view, 1);
    c.k1 = 256.0f, c.k2 = 0.0f, c.refine = 8;
    const Traced fine = trace(seen, c, false), tiles = trace(seen, c, true);
    for (std::size_t t = 0; t < fine.color.size(); ++t) {
      if (fine.color[t].w < 0.9f) continue;
      // Steps of two pixels may pass what is shorter.
      const auto x = static_cast<std::uint32_t>(t % c.size.x), y = static_cast<std::uint32_t>(t / c.size.x);
      const std::vector<Passing> passings = RayWalk(seen, c, {x, y}).passings();
      if (passings.empty() || passings[0].pixels < 2.0) continue;
      ++constant;
      both += tiles.color[t].w > 0.5f && std::abs(tiles.distance_m[t] - fine.distance_m[t]) < 0.1f ? 1 : 0;
    }
  }
  EXPECT_GT(constant, 2000u);
  EXPECT_GE(both, constant * 98 / 100) << constant;
}

TEST_F(ScreenSpaceMarch, a_floor_never_reflects_itself_or_the_sky) {
  ProxyRandom random(4);
  for (int i = 0; i < 8; ++i)
    for (const bool hierarchical : {false, true}) {
      ViewSettings settings = random_camera(random, 61, 37);
      settings.camera.orthographic = i % 4 == 3;
      settings.camera.half_height_m = 3.0f;
      const Traced traced = trace(look({}, settings), 1 + i % 2, hierarchical);
      for (const vec4& color : traced.color) ASSERT_EQ(color, vec4(0.0f));
    }
}

// Hard case: reflections.thin_foreground
TEST_F(ScreenSpaceMarch, rays_behind_a_thin_object_fall_back) {
  // A bar in front of the floor: the rays of the floor below it on the screen pass far behind it.
  SyntheticScene scene;
  scene.boxes.push_back({{-4.0, 0.7, 2.5}, {4.0, 0.76, 2.56}});
  const SyntheticView seen = look(scene, look_at({0.0, 1.0, 5.0}, {0.0, 0.4, 0.0}, 128, 96));
  for (const bool hierarchical : {false, true}) {
    const auto c = reflection_constants(seen.view, 1);
    const Traced traced = trace(seen, c, hierarchical);
    expect_sound(seen, c, traced, "bar");
    std::size_t behind = 0, smeared = 0;
    for (std::uint32_t y = 0; y < c.size.y; ++y)
      for (std::uint32_t x = 0; x < c.size.x; ++x) {
        const std::size_t texel = seen.at(x, y);
        if (seen.object[texel] != 0 || seen.position(x, y).z + 5.0 > 1.8) continue;  // behind the bar
        for (const Passing& passing : RayWalk(seen, c, {x, y}).passings()) behind += passing.behind_m > 0.5 ? 1 : 0;
        smeared += traced.color[texel].w > 0.0f ? 1 : 0;
      }
    EXPECT_GT(behind, 20u);
    EXPECT_EQ(smeared, 0u) << hierarchical;
  }
}

TEST_F(ScreenSpaceMarch, a_thin_object_is_reflected_where_rays_meet_it) {
  SyntheticScene scene;
  scene.boxes.push_back({{-0.1, 0.0, 1.0}, {0.1, 1.6, 1.2}});
  const SyntheticView seen = look(scene, look_at({0.3, 1.0, 5.0}, {0.0, 0.3, 0.0}, 128, 96));
  for (const bool hierarchical : {false, true}) {
    auto c = reflection_constants(seen.view, 1);
    c.k1 = 64.0f, c.k2 = 0.0f;
    const Found found = count_clear(seen, c, trace(seen, c, hierarchical));
    EXPECT_GT(found.expected, 50u);
    EXPECT_GE(found.full, found.expected * 95 / 100) << hierarchical;
  }
}

TEST_F(ScreenSpaceMarch, a_contact_is_reflected_right_beside_it) {
  SyntheticScene scene;
  scene.boxes.push_back({{-3.0, 0.0, -1.0}, {3.0, 2.5, 0.0}});
  const SyntheticView seen = look(scene, look_at({0.0, 1.2, 4.0}, {0.0, 0.3, 0.0}, 96, 64));
  for (const bool hierarchical : {false, true}) {
    const Traced traced = trace(seen, 1, hierarchical);
    for (std::uint32_t x = 16; x < 80; ++x) {
      std::uint32_t y = 0;
      while (seen.object[seen.at(x, y)] != 0) ++y;  // the first row of floor below the wall
      const std::size_t texel = seen.at(x, y + 1);
      EXPECT_GT(traced.color[texel].w, 0.9f) << x << ", " << hierarchical;
      EXPECT_NEAR(static_cast<double>(traced.distance_m[texel]), 1.5 * 0.10, 0.15) << x;
      EXPECT_NEAR(static_cast<double>(traced.color[texel].y) - 1.0, y - 1.5, 2.1) << x;
    }
  }
}

TEST_F(ScreenSpaceMarch, rays_along_one_column_are_followed) {
  // An odd width and an exact axis: the middle column's rays keep their x.
  SyntheticScene scene;
  scene.boxes.push_back({{-3.0, 0.0, -1.0}, {3.0, 2.5, 0.0}});
  const SyntheticView seen = look(scene, look_at({0.0, 1.0, 4.0}, {0.0, 0.5, 0.0}, 65, 64));
  for (const bool hierarchical : {false, true}) {
    const Traced traced = trace(seen, 1, hierarchical);
    for (std::uint32_t y = 0; y < 64; ++y) {
      const vec4 middle = traced.color[seen.at(32, y)], beside = traced.color[seen.at(31, y)];
      EXPECT_NEAR(middle.w, beside.w, 0.15f) << y;
      if (middle.w > 0.5f) {
        EXPECT_EQ(middle.x, 33.0f) << y;
      }
    }
    EXPECT_GT(traced.hits(), 500u);
  }
}

TEST_F(ScreenSpaceMarch, rays_that_leave_the_screen_find_nothing) {
  // The wall's image is above the upper border of the picture.
  SyntheticScene scene;
  scene.boxes.push_back({{-30.0, 0.8, -1.0}, {30.0, 4.0, 0.0}});
  const SyntheticView seen = look(scene, look_at({0.0, 1.0, 4.0}, {0.0, -1.5, 0.0}, 64, 48));
  for (const bool hierarchical : {false, true})
    for (const vec4& color : trace(seen, 1, hierarchical).color) ASSERT_EQ(color.w, 0.0f);
}

TEST_F(ScreenSpaceMarch, the_constant_march_has_steps_of_equal_length) {
  SyntheticScene scene;
  scene.boxes.push_back({{-9.0, 0.0, -1.0}, {9.0, 4.0, 0.0}});
  const SyntheticView seen = look(scene, look_at({0.0, 1.2, 5.0}, {0.0, 0.6, 0.0}, 64, 96));
  for (const float k2 : {0.0f, 0.2f}) {
    auto c = reflection_constants(seen.view, 1);
    c.k1 = 9.5f, c.k2 = k2, c.refine = 0;
    const Traced traced = trace(seen, c, false);
    std::size_t compared = 0;
    for (std::uint32_t y = 0; y < 96; ++y)
      for (std::uint32_t x = 0; x < 64; ++x) {
        if (seen.object[seen.at(x, y)] != 0) continue;
        const RayWalk walk(seen, c, {x, y});
        const double length = static_cast<double>(c.reach_m) / walk.direction().y;
        const double exact = 9.5 * std::exp(-static_cast<double>(k2) * walk.depth_m(walk.at(0.0)));
        const double count = std::max(std::floor(exact), 1.0), got = traced.distance_m[seen.at(x, y)];
        // Only rays that end on the screen have the full length.
        if (got == 0.0 || std::abs(walk.last_on_screen() - length) > 1e-6 || std::abs(exact - std::round(exact)) < 1e-3)
          continue;
        const double steps = got * count / length;
        ASSERT_NEAR(steps, std::round(steps), 0.01 * count / length + 1e-3) << x << ", " << y;
        ASSERT_LE(steps, count + 0.1);
        ++compared;
      }
    EXPECT_GT(compared, 200u) << k2;
  }
}

TEST_F(ScreenSpaceMarch, long_steps_do_not_pass_through_a_wall) {
  SyntheticScene scene;
  scene.boxes.push_back({{-9.0, 0.0, -1.0}, {9.0, 4.0, 0.0}});
  const SyntheticView seen = look(scene, look_at({0.0, 1.2, 5.0}, {0.0, 0.6, 0.0}, 64, 96));
  auto c = reflection_constants(seen.view, 1);
  c.k1 = 8.0f, c.k2 = 0.0f, c.refine = 10;
  const Found found = count_clear(seen, c, trace(seen, c, false));
  EXPECT_GT(found.expected, 500u);
  EXPECT_GE(found.full, found.expected * 98 / 100) << found.expected;
}

TEST_F(ScreenSpaceMarch, rays_that_cross_many_tiles_reach_what_they_meet) {
  // Hundreds of pixels: more than the march has steps.
  SyntheticScene scene;
  scene.boxes.push_back({{-9.0, 0.0, -1.0}, {9.0, 4.0, 0.0}});
  const SyntheticView seen = look(scene, look_at({0.0, 1.2, 5.0}, {0.0, 0.6, 0.0}, 5, 600));
  const auto c = reflection_constants(seen.view, 1);
  const Found found = count_clear(seen, c, trace(seen, c, true));
  EXPECT_GT(found.expected, 100u);
  EXPECT_GE(found.full, found.expected * 98 / 100) << found.expected;
}

TEST_F(ScreenSpaceMarch, rays_that_pass_behind_a_thin_object_find_what_stands_beyond) {
  SyntheticScene scene;
  scene.boxes.push_back({{-4.0, 0.7, 2.5}, {4.0, 0.76, 2.56}});
  scene.boxes.push_back({{-9.0, 0.0, -1.0}, {9.0, 4.0, 0.0}});
  const SyntheticView seen = look(scene, look_at({0.0, 1.0, 5.0}, {0.0, 0.6, 0.0}, 96, 96));
  const auto c = reflection_constants(seen.view, 1);
  const Traced traced = trace(seen, c, true);
  std::size_t expected = 0, found = 0;
  for (std::uint32_t y = 0; y < 96; ++y)
    for (std::uint32_t x = 16; x < 80; ++x) {
      if (seen.object[seen.at(x, y)] != 0) continue;
      const std::vector<Passing> passings = RayWalk(seen, c, {x, y}).passings();
      if (passings.size() != 2 || passings[0].behind_m < 0.8 || passings[1].behind_m > 0.1) continue;
      if (passings[1].pixels < 2.5) continue;
      ++expected;
      const std::size_t texel = seen.at(x, y);
      found += traced.color[texel].w > 0.5f && std::abs(traced.distance_m[texel] - passings[1].along_m) < 0.1 ? 1 : 0;
    }
  EXPECT_GT(expected, 50u);
  EXPECT_GE(found, expected * 95 / 100) << expected;
}

}  // namespace
}  // namespace gloam::test
