// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
// The streak of a shining panel in floors of several roughnesses, against traced reflections.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "tests/modules/reflections/judging/judged_scene.h"

namespace gloam::test {
namespace {

/// A streak in a picture, in pixels and cd/m².
struct Streak {
  double width = 0.0;   ///< at half of the greatest light of its row
  double length = 0.0;  ///< at half of the greatest light of its column
  double peak = 0.0;
  std::uint32_t row = 0;  ///< of the peak
};

/// Length of the part about the greatest value where values are above half of it, with linear interpolation.
double half_width(const std::vector<double>& values) {
  const auto top = static_cast<std::size_t>(std::ranges::max_element(values) - values.begin());
  const double half = 0.5 * values[top];
  const auto reach = [&](std::ptrdiff_t step) {
    double found = 0.0;
    for (auto i = static_cast<std::ptrdiff_t>(top); i + step >= 0 && i + step < std::ssize(values); i += step) {
      const double here = values[static_cast<std::size_t>(i)], next = values[static_cast<std::size_t>(i + step)];
      if (next < half) return found + (here - half) / (here - next);
      found += 1.0;
    }
    return found;
  };
  return reach(-1) + reach(1);
}

class LampStreaks : public JudgedReflections {
 protected:
  void build(float roughness) {
    environment() = {.sky_zenith = vec3(0.0f), .sky_horizon = vec3(0.0f), .sky_ground = vec3(0.0f)};
    settings = look_at(dvec3(0.0, 1.5, 5.0), dvec3(0.0, 0.2, -2.0), 320, 180);
    settings.camera.fov_y = 0.8f;
    ground(mirror(roughness), {0.0, 0.0, 0.0}, {1.2, 5.0});
    solid(glow(vec3(8.0f)), {0.0, 1.2, -4.0}, {0.12f, 0.4f, 0.02f});
    probe({}, {}, true);  // of nothing: rough floors have reflections, too
    capture(world, {}, {vec4(0.0f)});
  }
  /// The streak on the floor: light summed over three pixels across the measured line.
  [[nodiscard]] Streak streak_of(const LinearPicture& picture, const GeometryPicture& seen) const {
    const auto light = [&](std::uint32_t x, std::uint32_t y) {
      if (seen.is_sky(std::size_t{y} * settings.width + x)) return 0.0;
      const bool floor = std::abs(seen.position(x, y).y + seen.view.position.y) < 1e-3;
      return floor ? pixel(picture, x, y).g : 0.0;
    };
    const std::uint32_t middle = settings.width / 2;
    std::vector<double> column, row;
    for (std::uint32_t y = 0; y < settings.height; ++y) {
      double sum = 0.0;
      for (std::uint32_t x = middle - 2; x < middle + 2; ++x) sum += light(x, y) / 4.0;
      column.push_back(sum);
    }
    Streak streak;
    streak.length = half_width(column);
    streak.row = static_cast<std::uint32_t>(std::ranges::max_element(column) - column.begin());
    streak.peak = column[streak.row];
    for (std::uint32_t x = 0; x < settings.width; ++x) {
      double sum = 0.0;
      for (std::uint32_t y = streak.row - 1; y <= streak.row + 1; ++y) sum += light(x, y) / 3.0;
      row.push_back(sum);
    }
    streak.width = half_width(row);
    return streak;
  }
  void judge(float roughness, std::uint32_t rays) {
    build(roughness);
    const LinearPicture found = drawn();
    const GeometryPicture seen = geometry();
    const Streak expected = streak_of(traced(rays), seen), streak = streak_of(found, seen);
    std::printf("roughness %.2f: width %.1f (rays %.1f), length %.1f (%.1f), peak %.2f (%.2f) in row %u (%u)\n",
                static_cast<double>(roughness), streak.width, expected.width, streak.length, expected.length,
                streak.peak, expected.peak, streak.row, expected.row);
    EXPECT_GT(expected.length, 5.0);
    expect_at_most(std::abs(streak.width / expected.width - 1.0), 0.2, 0.25, "width off by");
    expect_at_most(std::abs(streak.peak / expected.peak - 1.0), 0.25, 0.3, "peak off by");
    EXPECT_GT(expected.peak, 0.05);
  }
};

TEST_F(LampStreaks, at_roughness_0_05) { judge(0.05f, 32); }
TEST_F(LampStreaks, at_roughness_0_1) { judge(0.1f, 64); }
TEST_F(LampStreaks, at_roughness_0_2) { judge(0.2f, 128); }
TEST_F(LampStreaks, at_roughness_0_3) { judge(0.3f, 128); }
TEST_F(LampStreaks, at_roughness_0_38) { judge(0.38f, 256); }
// Missed (docs/measurements-reflections.md): from a roughness of 0.49 on, probes alone show what a floor mirrors.
TEST_F(LampStreaks, at_roughness_0_5_are_left_to_the_probes) {
  build(0.5f);
  const LinearPicture all = drawn();
  set("reflections.tiers", "cube");
  EXPECT_EQ(drawn().rgba, all.rgba);
}

}  // namespace
}  // namespace gloam::test
