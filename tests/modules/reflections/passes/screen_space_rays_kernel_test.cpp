// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <limits>
#include <string>
#include <vector>

#include "shaders/reflections_test/shaders.h"
#include "tests/modules/reflections/support/trace_kernel.h"

namespace gloam::test {
namespace {

class ScreenSpaceTrace : public TraceKernelTest {};

TEST_F(ScreenSpaceTrace, rays_toward_the_camera_have_no_confidence) {
  SyntheticScene scene;
  scene.boxes.push_back({{-2.0, 0.3, -2.0}, {-0.5, 0.6, 2.0}});
  ViewSettings down = look_at({0.0, 3.0, 0.0}, {0.0, 0.0, 0.001}, 64, 48);
  for (const bool orthographic : {false, true})
    for (const bool hierarchical : {false, true}) {
      down.camera.orthographic = orthographic;
      down.camera.half_height_m = 2.0f;
      down.camera.fov_y = 0.25f;
      for (const vec4& color : trace(look(scene, down), 1, hierarchical).color) ASSERT_EQ(color.w, 0.0f);
    }
}

TEST_F(ScreenSpaceTrace, confidence_falls_to_nothing_where_rays_turn_toward_the_camera) {
  // The camera looks steeply down at the floor before a wall, whose front all rays meet.
  SyntheticScene scene;
  scene.boxes.push_back({{-5.0, 0.0, -1.0}, {5.0, 1.95, 0.0}});
  ViewSettings settings = look_at({0.0, 6.0, 2.15}, {0.0, 0.5, 0.25}, 64, 64);
  settings.camera.fov_y = 0.35f;
  const SyntheticView seen = look(scene, settings);
  for (const bool hierarchical : {false, true}) {
    const auto c = reflection_constants(seen.view, 1);
    const Traced traced = trace(seen, c, hierarchical);
    std::size_t toward = 0, away = 0;
    for (std::uint32_t y = 0; y < 64; ++y)
      for (std::uint32_t x = 8; x < 56; ++x) {
        const std::size_t texel = seen.at(x, y);
        if (seen.object[texel] != 0) continue;
        const RayWalk walk(seen, c, {x, y});
        const double cosine = glm::dot(walk.direction(), glm::normalize(-seen.position(x, y)));
        const auto passings = walk.passings();
        if (passings.empty() || passings[0].behind_m > 0.1) continue;
        toward += cosine > 0.82 ? 1 : 0;
        away += cosine < 0.8 && traced.color[texel].w > 0.0f ? 1 : 0;
        if (cosine > 0.82) {
          EXPECT_LT(traced.color[texel].w, 0.03f) << x << ", " << y;
        }
      }
    EXPECT_GT(toward, 100u) << hierarchical;
    EXPECT_GT(away, 20u) << hierarchical;
  }
}

TEST_F(ScreenSpaceTrace, rays_toward_the_camera_are_not_followed_and_no_texel_changes) {
  // The camera looks down at a wall's foot: rays of the near floor turn toward it, those of the far floor do not.
  SyntheticScene scene;
  scene.boxes.push_back({{-5.0, 0.0, -1.0}, {5.0, 1.95, 0.0}});
  ViewSettings settings = look_at({0.0, 3.0, 2.15}, {0.0, 0.0, 1.4}, 64, 64);
  settings.camera.fov_y = 1.0f;
  const SyntheticView seen = look(scene, settings);
  const auto c = reflection_constants(seen.view, 1);
  std::uint32_t mirrors = 0, toward = 0;
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      if (!is_mirror(seen, {x, y})) continue;
      ++mirrors;
      toward += glm::dot(seen.mirrored(x, y), glm::normalize(-seen.position(x, y))) > 0.8501 ? 1 : 0;
    }
  ASSERT_GT(toward, mirrors / 4);
  ASSERT_LT(toward, mirrors);
  for (const std::uint32_t hierarchical : {0u, 1u}) {
    const auto follow = [&](std::uint32_t all, std::uint32_t& rays) {
      Kernel kernel(device(), shaders::reflections_test::counted_rays_comp,
                    {{"kHierarchical", hierarchical}, {"kFollowAll", all}});
      kernel.in_out(11, std::vector<std::uint32_t>{0});
      Traced traced = run(kernel, seen, c, numbered(seen));
      rays = kernel.read<std::uint32_t>(11)[0];
      return traced;
    };
    std::uint32_t followed = 0, all = 0;
    const Traced some = follow(0, followed), whole = follow(1, all);
    EXPECT_EQ(all, mirrors);
    EXPECT_LE(followed, mirrors - toward);
    EXPECT_GT(followed, 0u);
    EXPECT_GT(whole.hits(), 20u);
    for (std::size_t i = 0; i < whole.color.size(); ++i) ASSERT_EQ(some.color[i], whole.color[i]) << i;
  }
}

// Hard case: reflections.straight_down, reflections.straight_up
TEST_F(ScreenSpaceTrace, straight_down_and_straight_up_give_numbers) {
  ProxyRandom random(5);
  const SyntheticScene scene = random_scene(random, 8);
  for (const double pitch : {-1.57079632679489661923, 1.57079632679489661923})
    for (const std::uint32_t scale : {1u, 2u})
      for (const bool hierarchical : {false, true}) {
        ViewSettings settings;
        settings.width = 61, settings.height = 37;
        settings.camera.fov_y = 2.0f;
        settings.world_from_camera =
            glm::rotate(glm::translate(dmat4(1.0), dvec3(0.0, 2.0, -3.0)), pitch, dvec3(1, 0, 0));
        const SyntheticView seen = look(scene, settings);
        const auto c = reflection_constants(seen.view, scale);
        expect_sound(seen, c, trace(seen, c, hierarchical), "down or up");
      }
}

TEST_F(ScreenSpaceTrace, confidence_falls_to_nothing_at_the_border_and_at_the_reach) {
  SyntheticScene scene;
  scene.boxes.push_back({{-30.0, 0.0, -1.0}, {30.0, 4.0, 0.0}});
  const SyntheticView seen = look(scene, look_at({0.0, 1.4, 5.0}, {0.0, 0.2, 0.0}, 96, 96));
  for (const bool hierarchical : {false, true}) {
    const auto c = reflection_constants(seen.view, 1);
    const Traced traced = trace(seen, c, hierarchical);
    std::size_t high = 0;
    for (std::uint32_t y = 0; y < 96; ++y)
      for (std::uint32_t x = 0; x < 96; ++x) {
        const std::size_t texel = seen.at(x, y);
        const vec4 color = traced.color[texel];
        if (color.w == 0.0f) continue;
        const RayWalk walk(seen, c, {x, y});
        const double height = static_cast<double>(traced.distance_m[texel]) * walk.direction().y;
        EXPECT_LT(height, static_cast<double>(c.reach_m) + 0.01);
        if (x == 0 || x == 95) {
          EXPECT_LT(color.w, 0.2f) << "the image is at the border of the screen";
        }
        if (height > 0.9 * static_cast<double>(c.reach_m)) {
          EXPECT_LT(color.w, 0.6f) << height;
          ++high;
        }
      }
    EXPECT_GT(high, 50u);
  }
}

TEST_F(ScreenSpaceTrace, sides_that_the_camera_does_not_see_are_not_reflected) {
  // A thin roof: the camera sees its top, rays meet its underside.
  SyntheticScene scene;
  scene.boxes.push_back({{-2.0, 0.5, -3.0}, {2.0, 0.502, 0.0}});
  const SyntheticView seen = look(scene, look_at({0.0, 1.6, 4.0}, {0.0, 0.3, -1.0}, 96, 64));
  for (const bool hierarchical : {false, true}) {
    const Traced traced = trace(seen, 1, hierarchical);
    for (const vec4& color : traced.color) {
      if (color.w == 0.0f) continue;
      const std::size_t pixel =
          seen.at(static_cast<std::uint32_t>(color.x) - 1, static_cast<std::uint32_t>(color.y) - 1);
      EXPECT_LT(unpack_normal_snorm16(seen.normals[pixel].y).y, 0.5f) << "a top that faces away from the ray";
    }
  }
}

// Hard case: reflections.nan_light
TEST_F(ScreenSpaceTrace, light_that_is_no_number_is_black) {
  SyntheticScene scene;
  scene.boxes.push_back({{-3.0, 0.0, -1.0}, {3.0, 2.5, 0.0}});
  const SyntheticView seen = look(scene, look_at({0.0, 1.0, 4.0}, {0.0, 0.5, 0.0}, 32, 32));
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinite = std::numeric_limits<float>::infinity();
  for (const vec4& light : {vec4(nan), vec4(-1.0f), vec4(infinite), vec4(1e30f), vec4(nan, 2.0f, -infinite, nan)}) {
    const Traced traced = trace(seen, reflection_constants(seen.view, 1), true, std::vector<vec4>(32 * 32, light));
    EXPECT_GT(traced.hits(), 100u);
    for (const vec4& color : traced.color) {
      EXPECT_LE(color.r, 65504.0f);
      if (color.w > 0.0f && std::isnan(light.r)) {
        EXPECT_EQ(color.r, 0.0f);
        EXPECT_EQ(color.g, std::isnan(light.g) ? 0.0f : 2.0f);
      }
    }
  }
}

TEST_F(ScreenSpaceTrace, surfaces_that_are_rough_tilted_or_below_the_eye_take_no_part) {
  SyntheticScene scene;
  scene.boxes.push_back({{-3.0, 0.0, -1.0}, {3.0, 2.5, 0.0}});
  const ViewSettings settings = look_at({0.0, 1.0, 4.0}, {0.0, 0.5, 0.0}, 32, 32);
  EXPECT_GT(trace(look(scene, settings), 1, true).hits(), 100u);
  scene.floor_material = 0x00FF0000u;  // reflectivity 0
  EXPECT_EQ(trace(look(scene, settings), 1, true).hits(), 0u);
  scene.floor_material = 0xFFFF0080u;  // roughness 0.502
  EXPECT_EQ(trace(look(scene, settings), 1, true).hits(), 0u);
  scene.floor_material = 0xFFFF0000u;
  SyntheticView tilted = look(scene, settings);
  for (std::size_t i = 0; i < tilted.normals.size(); ++i)
    if (tilted.object[i] == 0) tilted.normals[i].y = pack_normal_snorm16(glm::normalize(vec3(0.6f, 1.0f, 0.0f)));
  EXPECT_EQ(trace(tilted, 1, true).hits(), 0u);
}

// Hard case: reflections.odd_sizes
TEST_F(ScreenSpaceTrace, half_size_images_have_a_texel_for_each_block_of_odd_pictures) {
  SyntheticScene scene;
  scene.boxes.push_back({{-3.0, 0.0, -1.0}, {3.0, 2.5, 0.0}});
  for (const uvec2 size : {uvec2(7, 5), uvec2(1, 1), uvec2(61, 37), uvec2(2, 3)}) {
    const SyntheticView seen = look(scene, look_at({0.0, 1.0, 4.0}, {0.0, 0.2, 0.0}, size.x, size.y));
    for (const bool hierarchical : {false, true}) {
      const auto c = reflection_constants(seen.view, 2);
      expect_sound(seen, c, trace(seen, c, hierarchical), "odd size");
    }
  }
}

}  // namespace
}  // namespace gloam::test
