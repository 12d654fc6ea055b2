// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "tests/modules/lights/lists/light_scenes.h"

namespace gloam {
namespace {

using test::LightScene;
using test::point_lamp;
using test::spot_lamp;

constexpr int kMany = 1024;  // as many as a frame has

/// 1,024 lights where bounds, depths and tiles coincide.
class CrowdedLights : public test::LightScenesTest {
 protected:
  Drawn expect_all(LightScene s, const std::string& what) {
    Drawn frame = expect_tiled_is_brute_and_release(std::move(s), what);
    EXPECT_EQ(counter(frame, "lights.total"), kMany) << what;
    EXPECT_GT(brightest(frame.light), 0.07f) << what << ": no brighter than the sky";
    return frame;
  }
  /// Through the corner of a tile of 8 pixels: the tiles are those of light lists.
  [[nodiscard]] static dvec3 tile_corner(const LightScene& s, std::uint32_t x, std::uint32_t y, double depth) {
    const double slope = std::tan(0.5 * static_cast<double>(s.view.camera.fov_y));
    const double u = (16.0 * x / s.view.width - 1.0) * s.view.width / s.view.height, v = 1.0 - 16.0 * y / s.view.height;
    return dvec3(s.view.world_from_camera * dvec4(u * slope * depth, v * slope * depth, -depth, 1.0));
  }
};

// Hard case: selftest.lights_at_one_place, further.lights_1024_one_point
TEST_F(CrowdedLights, in_one_point_are_one_light_of_their_intensity) {
  const dvec3 at(0.3, 0.8, 0.0);
  LightScene many = stage();
  for (int i = 0; i < kMany; ++i) many.light(point_lamp(2.0f / kMany, 1.5f), at);
  const Drawn frame = expect_all(std::move(many), "in one point");
  LightScene one = stage();
  one.light(point_lamp(2.0f, 1.5f), at);
  const Drawn expected = expect_tiled_is_brute_and_release(std::move(one), "one");
  ASSERT_EQ(frame.light.rgba.size(), expected.light.rgba.size());
  double worst = 0.0;
  for (std::size_t i = 0; i < frame.light.rgba.size(); ++i) {
    const auto a = static_cast<double>(frame.light.rgba[i]), b = static_cast<double>(expected.light.rgba[i]);
    worst = test::worse(worst, std::abs(a - b) / std::max(b, 1e-2));
  }
  EXPECT_LE(worst, 2e-3) << "two steps of a half float, and the rounding of 1,024 sums";
}

// Hard case: further.lights_1024_coplanar
TEST_F(CrowdedLights, in_a_plane_are_the_same_from_lists_as_from_all_lights) {
  const dmat4 camera = stage().view.world_from_camera;
  const auto in_plane = [&](const std::string& what, const dvec3& origin, const dvec3& u, const dvec3& v,
                            float range_m = 0.4f) {
    LightScene s = stage();
    for (int i = 0; i < kMany; ++i) {
      const dvec3 at = origin + u * ((i % 32 - 15.5) / 16.0) + v * ((i / 32 - 15.5) / 16.0);
      s.light(i % 2 == 0 ? point_lamp(0.05f, range_m) : spot_lamp(0.2f, 1.5f * range_m, 0.7f), at);
    }
    expect_all(std::move(s), what);
  };
  in_plane("in the floor", dvec3(0.0), dvec3(3.0, 0.0, 0.0), dvec3(0.0, 0.0, 4.0));
  in_plane("above the floor", dvec3(0.0, 0.2, 0.0), dvec3(3.0, 0.0, 0.0), dvec3(0.0, 0.0, 4.0));
  const dvec3 eye(camera[3]), right(camera[0]), up(camera[1]), ahead = -dvec3(camera[2]);
  in_plane("at one depth", eye + 5.0 * ahead, 2.5 * right, 1.5 * up);
  in_plane("in the plane of the near plane", eye + 0.1 * ahead, 0.1 * right, 0.1 * up, 2.0f);
  in_plane("in a plane through the eye", eye + 3.0 * ahead, 3.0 * ahead, 0.9 * up);
}

// Hard case: further.lights_1024_tile_borders
TEST_F(CrowdedLights, on_the_borders_of_tiles_are_the_same_from_lists_as_from_all_lights) {
  for (const bool touching : {false, true}) {
    LightScene s = stage();
    s.view.width = 96;  // 12 by 8 tiles
    s.view.height = 64;
    for (int i = 0; i < kMany; ++i) {
      const std::uint32_t column = i % 13, row = i / 13 % 9;
      const double depth = 1.0 + 0.5 * (i / 117);
      if (!touching) {  // the centre is on a corner of four tiles
        s.light(point_lamp(0.05f, 0.3f), tile_corner(s, column, row, depth));
        continue;
      }
      // The outline touches borders: as wide as a tile, around its middle.
      const dvec3 middle = 0.5 * (tile_corner(s, column, row, depth) + tile_corner(s, column + 1, row + 1, depth));
      const double half =
          0.5 * glm::distance(tile_corner(s, column, row, depth), tile_corner(s, column + 1, row, depth));
      s.light(point_lamp(0.05f, static_cast<float>(half)), middle);
    }
    expect_all(std::move(s), touching ? "as wide as tiles" : "at corners");
  }
}

}  // namespace
}  // namespace gloam
