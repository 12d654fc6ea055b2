// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Blades narrower than a pixel: lines without gaps that cover as much as blades of many samples a pixel do.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/modules/grass/support/grass_stage.h"

namespace gloam::test {
namespace {

constexpr std::uint32_t kFiner = 6;  // samples along a side of a pixel
constexpr std::size_t kParts = 4;    // of a blade's length

using GrassPixelWidth = GrassTest;

/// A view whose pixels are as wide as those of 640x360 with a height of 0.9 radians.
ViewSettings view_at(double distance_m, std::uint32_t finer) {
  ViewSettings view = look_at({0.0, 0.35, distance_m}, {0.0, 0.1, 0.0}, 160 * finer, 40 * finer);
  view.camera.fov_y = 2.0f * std::atan(std::tan(0.45f) * 40.0f / 360.0f);
  return view;
}

/// Pixels of grass by the part of the blade that they show.
std::array<double, kParts> covered(GrassStage& stage, const ViewSettings& view) {
  std::array<double, kParts> pixels{};
  for (const vec4& value : stage.shown(view, "grass_lod")) {
    if (value.x < 0.5f) continue;
    const auto part = static_cast<std::size_t>(std::clamp(value.y, 0.0f, 0.999f) * kParts);
    pixels[part] += 1.0;
  }
  return pixels;
}

TEST_F(GrassPixelWidth, blades_cover_along_their_length_as_much_as_with_many_samples) {
  constexpr int kShifts = 6;
  const int lawns = scaled(20);
  for (const double distance_m : {2.0, 5.0, 10.0, 20.0}) {
    std::array<double, kParts> found{}, wanted{};
    for (int seed = 1; seed <= lawns; ++seed) {
      GrassStage stage;
      GrassSurface values;
      values.width_m = 0.008f;
      values.seed = static_cast<std::uint32_t>(seed);
      // So sparse that few blades are before another.
      const auto half_m = static_cast<float>(0.12 * distance_m);
      stage.lawn(half_m, static_cast<std::uint32_t>(6.0 * distance_m * std::sqrt(distance_m)), dvec3(0.0), values);
      stage.wind(vec3(4.0f, 0.0f, 1.0f), 0.3f);
      stage.set("grass.lod_pixels", "0");
      stage.set("grass.segments", "full");
      stage.run_at(1.0 / 30.0);
      stage.draw(view_at(distance_m, 1), 10);
      stage.run_at(0.0);
      for (int shift = 0; shift < kShifts; ++shift) {
        ViewSettings view = view_at(distance_m, 1);
        view.world_from_camera[3].x += 0.0027 * shift * distance_m;
        const auto some = covered(stage, view);
        for (std::size_t i = 0; i < kParts; ++i) found[i] += some[i] / kShifts;
      }
      const std::array<double, kParts> fine = covered(stage, view_at(distance_m, kFiner));
      for (std::size_t i = 0; i < kParts; ++i) wanted[i] += fine[i] / (kFiner * kFiner);
    }
    std::printf("%.0f m:", distance_m);
    for (std::size_t i = 0; i < kParts; ++i) {
      std::printf("  %.1f of %.1f", found[i], wanted[i]);
      // The last part is drawn by few pixels.
      EXPECT_NEAR(found[i], wanted[i], (i + 1 < kParts ? 0.1 : 0.13) * wanted[i]) << distance_m << " m, part " << i;
    }
    std::printf(" pixels\n");
  }
}

/// Rows between the lowest and the highest pixel of a lone blade that show none of it.
TEST_F(GrassPixelWidth, a_lone_blade_is_one_line) {
  std::size_t rows = 0, gaps = 0;
  for (const double distance_m : {2.0, 5.0, 10.0})
    for (int seed = 1; seed <= scaled(12); ++seed) {
      GrassStage stage;
      GrassSurface values;
      values.width_m = 0.008f;
      values.seed = static_cast<std::uint32_t>(seed);
      stage.lawn(0.02f, 1, dvec3(0.0), values);
      stage.set("grass.lod_pixels", "0");
      stage.set("grass.segments", "full");
      ViewSettings view = view_at(distance_m, 1);
      view.height = 120;
      view.camera.fov_y = 2.0f * std::atan(std::tan(0.45f) * 120.0f / 360.0f);
      const std::vector<vec4> values_shown = stage.shown(view, "grass_lod");
      int first = -1, last = -1;
      std::vector<bool> shown(view.height);
      for (std::size_t i = 0; i < values_shown.size(); ++i) {
        if (values_shown[i].x < 0.5f) continue;
        const int y = static_cast<int>(i / view.width);
        shown[static_cast<std::size_t>(y)] = true;
        first = first < 0 ? y : first;
        last = y;
      }
      for (int y = first; y >= 0 && y <= last; ++y, ++rows) gaps += shown[static_cast<std::size_t>(y)] ? 0 : 1;
    }
  EXPECT_GT(rows, 200u);
  EXPECT_EQ(gaps, 0u) << "of " << rows << " rows";
}

}  // namespace
}  // namespace gloam::test
