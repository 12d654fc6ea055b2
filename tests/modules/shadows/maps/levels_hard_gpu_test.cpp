// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "tests/modules/shadows/support/hard_shadows.h"

namespace gloam {
namespace {

/// Maps drawn with levels of detail (shadows.lod_texels).
class ShadowLevels : public test::HardShadows {
 protected:
  /// A ground with thin ridges and more than 131,072 triangles, and a fine ball above it. Its side is 6 · size.
  void ridges_and_ball(float size) {
    constexpr std::uint32_t kCells = 260;
    Primitive ground;
    ground.material = stone;
    for (std::uint32_t z = 0; z <= kCells; ++z)
      for (std::uint32_t x = 0; x <= kCells; ++x) {
        const float u = 6.0f * (static_cast<float>(x) / kCells - 0.5f),
                    v = 6.0f * (static_cast<float>(z) / kCells - 0.5f);
        const float height = 0.03f * std::max(0.0f, std::sin(4.0f * u + std::sin(2.0f * v)));
        ground.positions.push_back(size * vec3(u, height, v));
        ground.normals.push_back({0.0f, 1.0f, 0.0f});
      }
    for (std::uint32_t z = 0; z < kCells; ++z)
      for (std::uint32_t x = 0; x < kCells; ++x) {
        const std::uint32_t i = z * (kCells + 1) + x;
        for (const std::uint32_t v : {i, i + kCells + 1, i + 1, i + 1, i + kCells + 1, i + kCells + 2})
          ground.indices.push_back(v);
      }
    thing(test::finished(std::move(ground)));
    thing(test::round_ball(0.35f * size, 96, 48, stone), at(0.0, 0.6 * static_cast<double>(size), 0.0));
    const double s = static_cast<double>(size);
    settings = test::look_at(s * dvec3(0.3, 2.2, 3.4), s * dvec3(0.0, 0.3, 0.0), 128, 72);
    settings.camera.near_m *= size;
  }

  void expect_as_right_as_all_triangles(float size) {
    ridges_and_ball(size);
    const double s = static_cast<double>(size);
    Light bulb = point();
    bulb.range_m *= size;
    bulb.intensity *= size * size;
    const std::vector<Entity> lamps = {lamp(bulb, s * dvec3(-1.3, 1.9, 1.1), dvec3(0.0, -1.0, 0.0), 512),
                                       lamp(sun(), dvec3(0.0), dvec3(0.5, -0.6, -0.4), 512)};
    const TracedVisibility traced = trace(1);
    double all_triangles = 0.0;
    std::vector<double> wrong;
    for (const char* texels : {"0", "0.5", "1"}) {
      set("shadows.lod_texels", texels);
      draw();
      const double triangles = counter("shadows.triangles_drawn");  // first, because reading images draws frames
      std::printf("%s texels: %.0f triangles\n", texels, triangles);
      if (wrong.empty())
        all_triangles = triangles;
      else
        EXPECT_LT(triangles, 0.5 * all_triangles);
      for (std::size_t i = 0; i < lamps.size(); ++i) {
        const ShadowError e = error(lamps[i], traced);
        print(name_of(lamps[i]) + " " + texels + " texels", e);
        if (wrong.size() <= i) wrong.push_back(e.wrong_share());
        EXPECT_LE(e.wrong_share(), std::max(wrong[i], test::kMostWrong));
        EXPECT_LE(e.acne_share(), test::kMostWrong);
        EXPECT_LE(e.leak_share(), test::kMostWrong);
      }
    }
  }
};

// Hard case: lod.map_error
TEST_F(ShadowLevels, of_a_small_ball_over_thin_ridges_are_as_right_as_all_triangles) {
  expect_as_right_as_all_triangles(0.01f);
}

TEST_F(ShadowLevels, of_a_large_ball_over_thin_ridges_are_as_right_as_all_triangles) {
  expect_as_right_as_all_triangles(100.0f);
}

TEST_F(ShadowLevels, are_not_drawn_in_small_scenes) {
  yard();
  thing(test::round_ball(0.3f, 96, 48, stone), at(0.9, 0.4, 0.9));
  lamp(sun(), dvec3(0.0), dvec3(0.5, -0.6, -0.4), 512);
  std::vector<LinearPicture> pictures;
  for (const char* texels : {"0", "2"}) {
    set("shadows.lod_texels", texels);
    pictures.push_back(drawn());
  }
  EXPECT_EQ(pictures[0].rgba, pictures[1].rgba);
}

}  // namespace
}  // namespace gloam
