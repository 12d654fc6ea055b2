// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "modules/lights/lists/buffers.h"
#include "modules/lights/outputs.h"
#include "tests/modules/lights/lists/light_scenes.h"

namespace gloam {
namespace {

using test::LightScene;
using test::point_lamp;

/// The GPU's counters against a manual count: a wall across the view at z = 0, with lamps just in front of it.
struct LightCounterTest : test::LightScenesTest {
  static constexpr double kDistance = 4.0;

  [[nodiscard]] LightScene wall(std::uint32_t width, std::uint32_t height) const {
    LightScene s = empty_scene();
    s.draw(s.make.mesh(test::quad(50.0f, s.make.material(exact_material(200, 180, 160, 128, 0)))), dmat4(1.0));
    s.look(dvec3(0.0, 0.0, kDistance), dvec3(0.0), width, height);
    return s;
  }
  /// Size of a pixel of the wall in metres.
  [[nodiscard]] static double pixel_m(const LightScene& s) {
    return 2.0 * kDistance * std::tan(0.5 * static_cast<double>(s.view.camera.fov_y)) / s.view.height;
  }
  /// World position of a pixel of the wall.
  [[nodiscard]] static dvec3 at_pixel(const LightScene& s, double x, double y) {
    return {(x - 0.5 * s.view.width) * pixel_m(s), (0.5 * s.view.height - y) * pixel_m(s), 0.0};
  }
  [[nodiscard]] Drawn settled(LightScene& s) {
    Drawn frame;
    for (int i = 0; i < 4; ++i) frame = drawn(*s.world, s.view, "tiled");
    return frame;
  }
};

TEST_F(LightCounterTest, of_lamps_each_in_one_tile_are_one_a_tile) {
  LightScene s = wall(32, 24);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x)
      s.light(point_lamp(1.0f, static_cast<float>(2.0 * pixel_m(s))), at_pixel(s, 8.0 * x + 4.0, 8.0 * y + 4.0));
  const Drawn frame = settled(s);
  EXPECT_EQ(counter(frame, "lights.visible"), 12.0);
  EXPECT_EQ(counter(frame, "lights.per_tile_mask_mean"), 12.0) << "all tiles lie in one tile of 32×32";
  EXPECT_EQ(counter(frame, "lights.per_tile_candidates_mean"), 12.0) << "and all lamps at the wall's depth";
  EXPECT_EQ(counter(frame, "lights.per_tile_approx_mean"), 1.0);
  EXPECT_EQ(counter(frame, "lights.per_tile_accurate_mean"), 1.0);
  EXPECT_EQ(counter(frame, "lights.per_tile_group_mean"), 12.0);
  EXPECT_EQ(counter(frame, "lights.list_entries"), 36.0) << "one, rounded up to a word of three, in 12 tiles";
  EXPECT_EQ(counter(frame, "lights.list_capacity"), 12.0 * entries_that_fit_all(12, 12));
  EXPECT_EQ(counter(frame, "lights.overflow_tiles"), 0.0);
  EXPECT_EQ(counter(frame, "lights.culling_errors"), 0.0);
  renderer->release_world(*s.world);
}

TEST_F(LightCounterTest, of_lamps_that_reach_no_pixel_are_approximate_only) {
  LightScene s = wall(16, 16);
  // Between four pixels, with a range that ends before the nearest pixel centre.
  s.light(point_lamp(1.0f, static_cast<float>(0.6 * pixel_m(s))), at_pixel(s, 4.0, 4.0));
  const Drawn frame = settled(s);
  EXPECT_EQ(counter(frame, "lights.per_tile_approx_mean"), 0.25);
  EXPECT_EQ(counter(frame, "lights.per_tile_accurate_mean"), 0.0);
  EXPECT_EQ(counter(frame, "lights.list_entries"), 3.0);
  renderer->release_world(*s.world);
}

TEST_F(LightCounterTest, of_tiles_of_sky_are_not_in_the_means) {
  LightScene s = empty_scene();
  s.look(dvec3(0.0, 0.0, kDistance), dvec3(0.0), 64, 32);
  // A wall over the left part of the picture, up to the middle of a column of tiles.
  const double edge = at_pixel(s, 28.0, 0.0).x;
  s.draw(s.make.mesh(test::quad(50.0f, s.make.material(exact_material(200, 180, 160, 128, 0)))),
         glm::translate(dmat4(1.0), dvec3(edge - 50.0, 0.0, 0.0)));
  s.light(point_lamp(1.0f, 1000.0f), dvec3(0.0, 0.0, 2.0));
  const Drawn frame = settled(s);
  EXPECT_EQ(counter(frame, "lights.per_tile_accurate_mean"), 1.0);
  EXPECT_EQ(counter(frame, "lights.list_entries"), 4.0 * 4.0 * 3.0) << "four columns and four rows have a surface";
  renderer->release_world(*s.world);
}

TEST_F(LightCounterTest, are_of_the_last_frame_after_a_wait_and_gone_with_the_lists) {
  LightScene s = wall(16, 16);
  const Entity lamp = s.light(point_lamp(1.0f, 1000.0f), dvec3(0.0, 0.0, 2.0));
  EXPECT_EQ(counter(drawn(*s.world, s.view, "tiled"), "lights.list_entries"), 12.0) << "in the very first frame";
  const Entity second = s.light(point_lamp(1.0f, 1000.0f), dvec3(1.0, 0.0, 2.0));
  const Drawn two = drawn(*s.world, s.view, "tiled");
  EXPECT_EQ(counter(two, "lights.per_tile_accurate_mean"), 2.0);
  EXPECT_FALSE(drawn(*s.world, s.view, "brute").counters.contains("lights.list_entries"));
  s.world->destroy(lamp);
  s.world->destroy(second);
  EXPECT_FALSE(drawn(*s.world, s.view, "tiled").counters.contains("lights.list_entries"));
  renderer->release_world(*s.world);
}

TEST_F(LightCounterTest, of_two_views_are_those_of_the_last_one) {
  LightScene s = wall(16, 16);
  s.light(point_lamp(1.0f, 1000.0f), dvec3(0.0, 0.0, 2.0));
  ViewRequest small{s.view, {}};
  ViewRequest large = small;
  large.settings.id = ViewId{1};
  large.settings.width = 32;
  set("lights.culling", "tiled");
  for (const bool large_last : {true, false}) {
    const ViewRequest both[] = {large_last ? small : large, large_last ? large : small};
    ASSERT_TRUE(renderer->render(*s.world, both).ok());
    ASSERT_TRUE(renderer->wait().ok());
    EXPECT_EQ(renderer->report().counters.at("lights.list_entries"), large_last ? 24.0 : 12.0);
  }
  renderer->release_world(*s.world);
}

TEST_F(LightCounterTest, of_more_lights_than_fit_are_told_once) {
  LightScene s = wall(16, 16);
  for (int i = 0; i < 1100; ++i)
    s.light(point_lamp(1.0f + static_cast<float>(i), 1000.0f), dvec3(0.01 * (i % 100), 0.0, 2.0));
  for (int i = 0; i < 3; ++i) {
    const Drawn frame = drawn(*s.world, s.view, "tiled");
    EXPECT_EQ(counter(frame, "lights.dropped"), 76.0);
    EXPECT_EQ(counter(frame, "lights.per_tile_accurate_mean"), 1024.0);
  }
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings.front().find("lights.dropped"), std::string::npos) << warnings.front();
  renderer->release_world(*s.world);
}

}  // namespace
}  // namespace gloam
