// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "tests/modules/lights/lists/light_scenes.h"

namespace gloam {
namespace {

using test::LightScene;
using test::LightScenesTest;
using test::point_lamp;
using test::spot_lamp;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Difficult lights on the stage.
struct HardCase {
  const char* name;
  std::function<void(LightScene&)> add;
};

const dvec3 kEye(0.6, 1.7, 5.0);

void add_not_numbers(LightScene& s) {
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional}) {
      Light light = point_lamp(bad, 3.0f);
      light.kind = kind;
      s.light(light, dvec3(0.0, 1.0, 0.0));
      light = point_lamp(3.0f, bad);
      light.kind = kind;
      light.color.g = bad;
      s.light(light, dvec3(0.0, 1.0, 0.0));
      light = point_lamp(3.0f, 3.0f);
      light.kind = kind;
      light.outer_angle = light.inner_angle = bad;
      s.light(light, dvec3(0.5, 1.0, 0.0));
      light.outer_angle = 0.6f;
      light.inner_angle = 0.1f;
      dmat4 node = LightScene::node_towards(dvec3(static_cast<double>(bad), 1.0, 0.0), dvec3(0.0, -1.0, 0.0));
      s.light(light, node);
      node = LightScene::node_towards(dvec3(0.0, 1.0, 0.0), dvec3(0.0, -1.0, 0.0));
      node[2][1] = static_cast<double>(bad);
      s.light(light, node);
    }
  }
  s.light(point_lamp(3.0f, 4.0f), dvec3(0.3, 1.2, 0.0));
}

void add_on_odd_nodes(LightScene& s) {
  const dmat4 down = LightScene::node_towards(dvec3(0.0), dvec3(0.2, -1.0, 0.1));
  dmat4 shear(1.0);
  shear[2][0] = 1.5;
  shear[1][2] = -0.7;
  const dvec3 scales[] = {dvec3(0.0),
                          dvec3(0.0, 1.0, 1.0),
                          dvec3(1.0, 1.0, 0.0),
                          dvec3(-1.0, 1.0, 1.0),
                          dvec3(-3.0, -3.0, -3.0),
                          dvec3(1e-6),
                          dvec3(1e5)};
  double x = -3.0;
  for (const dvec3& scale : scales) {
    x += 0.8;
    const dmat4 place = glm::translate(dmat4(1.0), dvec3(x, 1.5, 0.4));
    s.light(spot_lamp(6.0f, 4.0f, 0.6f), place * down * glm::scale(dmat4(1.0), scale));
    s.light(spot_lamp(6.0f, 4.0f, 0.6f), place * down * shear * glm::scale(dmat4(1.0), scale));
    s.light(point_lamp(1.0f, 2.0f), place * down * shear * glm::scale(dmat4(1.0), scale));
  }
}

const HardCase kHardCases[] = {
    {"one light", [](LightScene& s) { s.light(point_lamp(5.0f, 4.0f), dvec3(0.3, 1.2, 0.0)); }},
    {"the camera inside lights",
     [](LightScene& s) {
       s.light(point_lamp(5.0f, 8.0f), kEye);
       s.light(point_lamp(5.0f, 5.0f), kEye + dvec3(0.3, 0.2, -0.5));
       s.light(spot_lamp(5.0f, 9.0f, 0.5f), kEye + dvec3(0.0, 0.0, 0.4), dvec3(-0.1, -0.2, -1.0));
       s.light(spot_lamp(5.0f, 9.0f, 1.5707f), kEye, dvec3(0.0, -0.4, -1.0));
     }},
    {"lights across the near plane",
     [](LightScene& s) {
       const dvec3 forward = glm::normalize(dvec3(-0.6, -1.0, -6.0));
       s.light(point_lamp(0.1f, 0.05f), kEye + forward * 0.1);
       s.light(point_lamp(0.1f, 0.9f), kEye + forward * 0.7);
       s.light(point_lamp(3.0f, 1.2f), kEye - forward * 0.5);
       s.light(spot_lamp(3.0f, 3.0f, 0.7f), kEye - forward * 0.6, forward);
     }},
    {"lights behind the camera",
     [](LightScene& s) {
       s.light(point_lamp(5.0f, 2.0f), kEye + dvec3(0.0, 0.0, 5.0));
       s.light(point_lamp(50.0f, 8.0f), kEye + dvec3(0.0, 0.0, 5.0));
       s.light(spot_lamp(50.0f, 9.0f, 0.4f), kEye + dvec3(0.0, 0.0, 5.0), dvec3(0.0, 0.0, 1.0));
     }},
    {"lights of no extent",
     [](LightScene& s) {
       s.light(point_lamp(5.0f, 1e-30f), dvec3(0.3, 1.2, 0.0));
       s.light(point_lamp(5.0f, 1e-6f), dvec3(0.0, 0.0, 0.0));
       s.light(spot_lamp(5.0f, 1e-6f, 0.4f), dvec3(0.1, 0.0, 0.1));
       s.light(point_lamp(1.0f, 2.0f), dvec3(0.3, 1.2, 0.0));
     }},
    {"lights without a range",
     [](LightScene& s) {
       s.light(point_lamp(0.5f), dvec3(0.3, 1.2, 0.0));
       s.light(point_lamp(300.0f), dvec3(0.3, 3.0, 60.0));
       s.light(spot_lamp(3.0f, 0.0f, 0.5f), dvec3(-1.0, 2.0, 0.0));
     }},
    {"lights with values that are no numbers", add_not_numbers},
    {"negative intensity",
     [](LightScene& s) {
       s.light(point_lamp(-5.0f, 4.0f), dvec3(0.3, 1.2, 0.0));
       s.light(spot_lamp(-5.0f, 0.0f, 0.5f), dvec3(-0.3, 1.2, 0.0));
       s.light(point_lamp(2.0f, 4.0f), dvec3(0.3, 1.0, 1.0));
     }},
    {"a million candela at a centimetre",
     [](LightScene& s) {
       s.light(point_lamp(1e6f), dvec3(0.0, 2.0, -4.99));
       s.light(point_lamp(1e6f, 3.0f), dvec3(0.6, 0.01, 1.0));
       s.light(spot_lamp(1e6f, 3.0f, 0.5f), dvec3(-0.6, 1.2, 1.51), dvec3(0.0, 0.0, -1.0));
     }},
    {"cones of many angles",
     [](LightScene& s) {
       double x = -3.0;
       for (const float degrees : {0.0f, 0.01f, 1.0f, 59.0f, 60.0f, 60.5f, 75.0f, 89.9f, 90.0f, 140.0f}) {
         Light light = spot_lamp(3.0f, 4.0f, glm::radians(degrees));
         light.inner_angle = x < 0.0 ? 0.0f : light.outer_angle;
         s.light(light, dvec3(x += 0.55, 1.6, 0.3), dvec3(0.3, -1.0, -0.2));
       }
     }},
    {"all in one place",
     [](LightScene& s) {
       for (int i = 0; i < 300; ++i) s.light(point_lamp(0.02f, 1.5f), dvec3(0.3, 0.8, 0.0));
     }},
    {"all in one bin",
     [](LightScene& s) {
       const dvec3 forward = glm::normalize(dvec3(-0.6, -1.0, -6.0));
       const dvec3 side = glm::normalize(glm::cross(forward, dvec3(0.0, 1.0, 0.0)));
       for (int i = 0; i < 200; ++i)
         s.light(point_lamp(0.3f, 1.0f),
                 kEye + forward * 5.0 + side * (0.03 * i - 3.0) + glm::cross(side, forward) * (0.7 * (i % 3) - 0.7));
     }},
    {"a light a hundred kilometres wide",
     [](LightScene& s) { s.light(point_lamp(1e8f, 1e5f), dvec3(9000.0, 4000.0, 3000.0)); }},
};

// Hard case: shadows.camera_inside_light, shadows.light_at_near_plane, shadows.light_behind_camera
// Hard case: shadows.zero_radius, shadows.without_range, shadows.position_not_finite, shadows.intensity_not_finite
// Hard case: shadows.range_not_finite, shadows.negative_intensity, shadows.cone_0, shadows.cone_120
// Hard case: shadows.cone_180, shadows.one_place, shadows.one_bin
TEST_F(LightScenesTest, of_hard_lights_are_the_same_from_lists_as_from_all_lights) {
  for (const HardCase& hard : kHardCases) {
    SCOPED_TRACE(hard.name);
    LightScene s = stage();
    hard.add(s);
    const Drawn frame = expect_tiled_is_brute_and_release(std::move(s), hard.name);
    if (HasFatalFailure()) return;
    EXPECT_GT(brightest(frame.light), 0.07f) << hard.name << ": no brighter than the sky";
  }
}

// Hard case: shadows.node_zero_scale, shadows.node_mirrored, shadows.node_sheared
TEST_F(LightScenesTest, on_flat_mirrored_and_sheared_nodes_are_the_same) {
  LightScene s = stage();
  add_on_odd_nodes(s);
  expect_tiled_is_brute_and_release(std::move(s), "odd nodes");
}

// Hard case: shadows.million_candela
TEST_F(LightScenesTest, of_a_million_candela_at_a_centimetre_saturate) {
  LightScene s = stage();
  s.light(point_lamp(1e6f), dvec3(0.0, 2.0, -4.99));
  const Drawn frame = expect_tiled_is_brute_and_release(std::move(s), "bright");
  EXPECT_GE(brightest(frame.light), 60000.0f);
}

// Hard case: shadows.lights_0, shadows.lights_1, shadows.lights_31, shadows.lights_32, shadows.lights_33
// Hard case: shadows.lights_1023, shadows.lights_1024, shadows.lights_1025, shadows.lights_5000
TEST_F(LightScenesTest, of_any_number_of_lights_are_the_same) {
  for (const int count : {0, 1, 31, 32, 33, 1023, 1024, 1025, 5000}) {
    LightScene s = stage();
    scatter(s, count, 3, 1.0);
    const Drawn frame = expect_tiled_is_brute_and_release(std::move(s), std::to_string(count) + " lights");
    if (HasFatalFailure()) return;
    if (count > 30) {  // fewer lights may all be out of view
      EXPECT_EQ(counter(frame, "lights.total"), count);
    }
  }
}

// Hard case: shadows.size_1x1, shadows.size_7x5, shadows.size_33x31
TEST_F(LightScenesTest, of_hard_sizes_are_the_same) {
  for (const uvec2 size : {uvec2(1, 1), uvec2(7, 5), uvec2(8, 8), uvec2(33, 31), uvec2(64, 64), uvec2(65, 63),
                           uvec2(257, 129), uvec2(3, 400)}) {
    LightScene s = stage();
    scatter(s, 60, 5, 1.4);
    s.view.width = size.x;
    s.view.height = size.y;
    expect_tiled_is_brute_and_release(std::move(s), std::to_string(size.x) + "x" + std::to_string(size.y));
    if (HasFatalFailure()) return;
  }
}

// Hard case: shadows.camera_orthographic, shadows.camera_rolled
TEST_F(LightScenesTest, of_hard_cameras_are_the_same) {
  struct Lens {
    const char* name;
    bool orthographic = false;
    float fov = 0.8f;
    float near_m = 0.1f;
    double roll = 0.0;
  };
  const Lens lenses[] = {{"orthographic", true},
                         {"orthographic, rolled, from a centimetre", true, 0.8f, 0.01f, 0.8},
                         {"rolled", false, 0.8f, 0.1f, 0.6},
                         {"upside down", false, 0.8f, 0.1f, 3.14159},
                         {"wide", false, 2.9f},
                         {"narrow", false, 0.02f},
                         {"near plane at a millimetre", false, 0.8f, 0.001f},
                         {"near plane in the middle of the stage", false, 0.8f, 4.5f}};
  for (const Lens& lens : lenses) {
    LightScene s = stage();
    scatter(s, 80, 7, 1.4);
    s.view.camera = {.orthographic = lens.orthographic,
                     .fov_y = lens.fov,
                     .half_width_m = 3.0f,
                     .half_height_m = 2.0f,
                     .near_m = lens.near_m};
    s.view.world_from_camera = s.view.world_from_camera * glm::rotate(dmat4(1.0), lens.roll, dvec3(0.0, 0.0, 1.0));
    expect_tiled_is_brute_and_release(std::move(s), lens.name);
    if (HasFatalFailure()) return;
  }
}

// Hard case: shadows.at_100_km
TEST_F(LightScenesTest, a_hundred_kilometres_from_the_origin_are_the_same) {
  const auto lit_stage = [&](const dvec3& origin) {
    LightScene s = stage(origin);
    scatter(s, 80, 11, 1.4);
    return expect_tiled_is_brute_and_release(std::move(s), "at " + std::to_string(origin.x));
  };
  const Drawn here = lit_stage(dvec3(0.0));
  EXPECT_GT(brightest(here.light), 0.1f);
  for (const dvec3& origin : {dvec3(1e5, 0.0, -1e5), dvec3(-3e4, 1e5, 7.0)}) {
    const Drawn there = lit_stage(origin);
    ASSERT_EQ(there.light.rgba.size(), here.light.rgba.size());
    // Positions in double are off by up to 7e-12 m there, so a few values in float round to their neighbours.
    std::size_t different = 0;
    for (std::size_t i = 0; i < here.light.rgba.size(); ++i) {
      const float a = here.light.rgba[i], b = there.light.rgba[i];
      different += std::abs(a - b) <= 2e-3f * std::max(a, 0.01f) ? 0 : 1;
    }
    EXPECT_LE(different, here.light.rgba.size() / 1000) << "at " << origin.x;
  }
}

// Hard case: shadows.near_to_far
TEST_F(LightScenesTest, from_a_centimetre_to_100_kilometres_are_the_same) {
  LightScene s = stage();
  s.view.camera.near_m = 0.01f;
  scatter(s, 40, 13, 1.4);
  const std::uint32_t board = s.make.mesh(test::quad(1.0f));
  for (const double depth : {0.02, 0.1, 30.0, 1e3, 1e5}) {  // each about 3.4 degrees wide, side by side over the stage
    const dvec3 to = glm::normalize(dvec3(-0.25 + 0.05 * std::log10(depth), 0.06, -1.0));
    s.draw(board, glm::scale(glm::translate(dmat4(1.0), kEye + to * depth), dvec3(0.03 * depth)));
    s.light(point_lamp(static_cast<float>(0.02 * depth * depth), static_cast<float>(0.2 * depth)),
            kEye + to * (0.95 * depth));
  }
  expect_tiled_is_brute_and_release(std::move(s), "a centimetre to 100 kilometres");
}

// Hard case: shadows.one_far_light
TEST_F(LightScenesTest, of_one_far_light_are_the_same) {
  LightScene s = empty_scene();
  Material chalk;
  chalk.metallic = 0.0f;
  const std::uint32_t material = s.make.material(chalk);
  s.draw(s.make.mesh(test::box(vec3(0.2f), material)), glm::translate(dmat4(1.0), dvec3(0.5, 1.2, 3.5)));
  s.draw(s.make.mesh(test::quad(400.0f, material)), glm::translate(dmat4(1.0), dvec3(0.0, 0.0, -3000.0)));
  s.light(point_lamp(5e4f, 300.0f), dvec3(100.0, 50.0, -2950.0));
  const Drawn frame = expect_tiled_is_brute_and_release(std::move(s), "one far light");
  EXPECT_GT(brightest(frame.light), 0.5f);
}

/// Rasterisation interpolates over a pane of this size with errors of many of its pixels near the camera.
// Hard case: further.huge_triangle
TEST_F(LightScenesTest, through_glass_of_100_kilometres_are_the_same) {
  for (const double roll : {0.0, 0.7}) {
    LightScene s = stage();
    Material glass;
    glass.alpha_mode = AlphaMode::blend;
    glass.metallic = 0.0f;
    glass.base_color = vec4(0.5f, 0.7f, 0.5f, 0.5f);
    const dmat4 flat = glm::rotate(dmat4(1.0), glm::radians(-90.0), dvec3(1.0, 0.0, 0.0));
    s.draw(s.make.mesh(test::quad(1e5f, s.make.material(glass))),
           glm::translate(dmat4(1.0), dvec3(0.0, 1.0, 0.0)) * flat);
    scatter(s, 300, 43, 0.7);
    s.view.width = 257;
    s.view.height = 129;
    s.view.world_from_camera = s.view.world_from_camera * glm::rotate(dmat4(1.0), roll, dvec3(0.0, 0.0, 1.0));
    expect_tiled_is_brute_and_release(std::move(s), "glass of 100 kilometres");
  }
}

// Hard case: shadows.size_4095x2161
TEST_F(LightScenesTest, of_4095_columns_lose_no_light) {
  LightScene s = stage();
  scatter(s, 9, 47, 2.0);
  s.view.width = 4095;
  s.view.height = 2161;
  draw(*s.world, s.view);  // comparing its pictures would take longer than all the other cases
  const std::map<std::string, double> counters = renderer->report().counters;
  EXPECT_EQ(counters.at("lights.culling_errors"), 0.0);
  EXPECT_EQ(counters.at("lights.capacity_violations"), 0.0);
  EXPECT_GT(counters.at("lights.list_entries"), 10000.0);
  renderer->release_world(*s.world);
}

// Hard case: shadows.all_sky
TEST_F(LightScenesTest, of_nothing_but_sky_have_no_light_in_any_list) {
  LightScene s = empty_scene();
  scatter(s, 100, 17, 2.0);
  const Drawn frame = expect_tiled_is_brute_and_release(std::move(s), "all sky");
  EXPECT_EQ(counter(frame, "lights.list_entries"), 0.0);
  EXPECT_EQ(counter(frame, "lights.visible"), 0.0) << "such a view demands no lights";
}

// Hard case: shadows.sky_and_near
TEST_F(LightScenesTest, of_sky_and_near_things_in_one_tile_are_the_same) {
  LightScene s = empty_scene();
  const std::uint32_t pole = s.make.mesh(test::box(vec3(0.02f, 1.0f, 0.02f)));
  for (int i = 0; i < 30; ++i) s.draw(pole, glm::translate(dmat4(1.0), dvec3(-1.5 + 0.11 * i, 1.0, 4.0 - 0.9 * i)));
  scatter(s, 100, 19, 1.5);
  const Drawn frame = expect_tiled_is_brute_and_release(std::move(s), "poles before the sky");
  EXPECT_GT(counter(frame, "lights.list_entries"), 0.0);
}

/// FF figure 3: a tile whose nearest and farthest surfaces are in bins that do not hold the lights between them. Thin
/// poles stand there.
// Hard case: shadows.figure_3_between
TEST_F(LightScenesTest, of_figure_3_light_what_stands_between_the_ends_of_a_tile) {
  for (const char* bins : {"256", "1024", "4096"}) {
    set("lights.z_bins", bins);
    LightScene s = empty_scene();
    s.look(dvec3(0.0, 0.0, 0.0), dvec3(0.0, 0.0, -1.0), 64, 64);
    s.view.camera.fov_y = 0.5f;
    for (int i = 0; i < 40; ++i) {  // poles a third of a pixel to a pixel apart, with growing distances
      const double depth = 1.0 + 0.5 * i;
      const std::uint32_t pole = s.make.mesh(test::box(vec3(dvec3(0.006, 0.3, 0.006) * depth)));
      s.draw(pole, glm::translate(dmat4(1.0), dvec3((0.012 * (i % 40) - 0.24) * depth, 0.0, -depth)));
    }
    s.light(point_lamp(2.0f, 2.0f), dvec3(0.0, 0.0, -4.0));
    s.light(point_lamp(4.0f, 5.0f), dvec3(0.0, 0.3, -9.0));
    s.light(point_lamp(0.4f, 0.8f), dvec3(0.0, 0.0, -6.5));
    s.light(point_lamp(0.4f, 0.3f), dvec3(0.0, 0.0, -15.5));
    const Drawn frame = expect_tiled_is_brute_and_release(std::move(s), std::string("figure 3 with bins ") + bins);
    EXPECT_GT(brightest(frame.light), 0.2f);
  }
}

}  // namespace
}  // namespace gloam
