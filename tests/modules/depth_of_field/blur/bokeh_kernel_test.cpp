// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "modules/depth_of_field/reference/spot.h"
#include "tests/modules/depth_of_field/support/dof_chain.h"

namespace gloam::test {
namespace {

constexpr float kBrightest = 65504.0f;

/// One pixel of the brightest light in a dark picture whose circles of confusion are equal.
class DofBokeh : public DofChainTest {
 protected:
  struct Setting {
    Bokeh bokeh = Bokeh::round;
    bool full = false;
    float radius = 15.0f;
    bool near = false;
    std::uint32_t shift = 0;  ///< of the bright pixel

    [[nodiscard]] std::string name() const {
      return std::string(full ? "full" : "half") + ", radius " + std::to_string(static_cast<int>(radius)) +
             (near ? ", near" : ", far") + ", shift " + std::to_string(shift);
    }
  };
  static Spot draw(const Setting& setting) {
    DofInput in(kWidth, kHeight, setting.near ? -setting.radius : setting.radius, vec4(0.0f, 0.0f, 0.0f, 1.0f));
    in.light[in.at(kWidth / 2 + setting.shift, kHeight / 2 + setting.shift / 2)] = vec4(vec3(kBrightest), 1.0f);
    in.knobs.full_resolution = setting.full;
    in.knobs.radius = 31.0f;
    in.bokeh = setting.bokeh;
    std::vector<double> values;
    for (const vec4& light : run(in).light) {
      EXPECT_TRUE(std::isfinite(light.x) && light.x >= 0.0f);
      EXPECT_TRUE(light.x == light.y && light.x == light.z);
      values.push_back(static_cast<double>(light.x));
    }
    return {static_cast<int>(kWidth), static_cast<int>(kHeight), std::move(values)};
  }
  template <class Check>
  static void each_setting(Bokeh bokeh, const Check& check) {
    for (const bool full : {false, true})
      for (const float radius : {15.0f, 31.0f})
        for (const bool near : {false, true})
          for (const std::uint32_t shift : {0u, 3u}) check(Setting{bokeh, full, radius, near, shift});
  }
  static constexpr std::uint32_t kWidth = 96, kHeight = 384;  // of 31 pixels, circles are within the limit
};
INSTANTIATE_TEST_SUITE_P(Variants, DofBokeh, testing::Values(true));

// Hard case: dof.bright_sum, selftest.bokeh
TEST_P(DofBokeh, keeps_the_energy_of_a_bright_pixel) {
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal})
    each_setting(bokeh, [](const Setting& setting) {
      const Spot spot = draw(setting);
      EXPECT_NEAR(spot.energy() / static_cast<double>(kBrightest), 1.0, 0.01) << setting.name();
    });
}

// Hard case: dof.bright_spreads
TEST_P(DofBokeh, spreads_a_bright_pixel) {
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal})
    each_setting(bokeh, [](const Setting& setting) {
      // A disc of a quarter of the radius is darker than if it held all light.
      const double alone = static_cast<double>(kBrightest) / (std::numbers::pi * std::pow(0.25 * setting.radius, 2));
      EXPECT_LT(draw(setting).mean_within(0.25 * setting.radius), 0.25 * alone) << setting.name();
    });
}

// Hard case: dof.bright_shape, selftest.bokeh
TEST_P(DofBokeh, is_the_same_in_all_directions_if_it_is_round) {
  each_setting(Bokeh::round, [](const Setting& setting) {
    const Spot spot = draw(setting);
    const dvec3 moments = spot.moments();
    EXPECT_NEAR(moments.x / moments.y, 1.0, 0.05) << setting.name();
    EXPECT_NEAR(moments.z / moments.y, 0.0, 0.05) << setting.name();
    const double level = 0.5 * spot.mean_within(1.0);
    double least = 1e9, most = 0.0;
    for (int i = 0; i < 64; ++i) {
      const double reach = glm::distance(spot.outline(i * std::numbers::pi / 32.0, level), spot.centre());
      least = std::min(least, reach);
      most = std::max(most, reach);
    }
    EXPECT_LT(most / least, 1.05) << setting.name();
    EXPECT_GT(least, 0.9 * setting.radius) << setting.name();
    EXPECT_LT(most, 1.1 * setting.radius) << setting.name();
  });
}

// A lamp far brighter than white shows the outline of its faint light.
// Hard case: dof.bright_shape
TEST_P(DofBokeh, stays_round_if_it_is_overexposed) {
  each_setting(Bokeh::round, [](const Setting& setting) {
    const Spot spot = draw(setting);
    for (const auto& [level, most_ratio] : {std::pair{0.01, 1.12}, {0.001, 1.2}}) {
      double least = 1e9, most = 0.0;
      for (int i = 0; i < 64; ++i) {
        const double reach =
            glm::distance(spot.outline(i * std::numbers::pi / 32.0, level * spot.mean_within(1.0)), spot.centre());
        least = std::min(least, reach);
        most = std::max(most, reach);
      }
      EXPECT_LT(most / least, most_ratio) << setting.name() << ", level " << level;
      EXPECT_LT(most, 1.6 * setting.radius) << setting.name() << ", level " << level;
    }
  });
}

// Hard case: dof.bright_shape, selftest.bokeh
TEST_P(DofBokeh, has_six_equal_sides_if_it_is_hexagonal) {
  each_setting(Bokeh::hexagonal, [](const Setting& setting) {
    const Spot spot = draw(setting);
    const double level = 0.5 * spot.mean_within(0.5 * setting.radius);
    const std::array<glm::dvec2, 6> corners = hexagon_corners(spot, level);
    double least = 1e9, most = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < 6; ++i) {
      const double length = glm::distance(corners[i], corners[(i + 1) % 6]);
      least = std::min(least, length);
      most = std::max(most, length);
      sum += length;
    }
    EXPECT_LT(most / least, 1.05) << setting.name();
    EXPECT_NEAR(sum / 6.0, setting.radius, 0.08 * setting.radius) << setting.name();
    for (int i = 0; i < 60; ++i) {
      const double angle = i * std::numbers::pi / 30.0;
      const double outer = glm::distance(spot.outline(angle, 0.1 * level), spot.centre());
      EXPECT_LT(outer, 1.12 * setting.radius + (setting.full ? 1.0 : 2.0)) << setting.name() << ", angle " << angle;
    }
  });
}

TEST_P(DofBokeh, is_evenly_lit_if_it_is_hexagonal) {
  each_setting(Bokeh::hexagonal, [](const Setting& setting) {
    const Spot spot = draw(setting);
    const double inside = 0.65 * setting.radius, mean = spot.mean_within(inside);
    const glm::dvec2 range = spot.range_within(inside);
    EXPECT_GT(range.x, 0.9 * mean) << setting.name();
    EXPECT_LT(range.y, 1.1 * mean) << setting.name();
  });
}

/// Share of the light of a square lamp, columns and rows [first, first + side), that a pixel shows: by 4 × 4 points of
/// each of its pixels.
double square_through_lens(Bokeh bokeh, double radius, int first, int side, int x, int y) {
  int inside = 0;
  for (int v = 0; v < 4 * side; ++v)
    for (int u = 0; u < 4 * side; ++u) {
      const double dx = std::abs(first + (u + 0.5) / 4.0 - (x + 0.5)),
                   dy = std::abs(first + (v + 0.5) / 4.0 - (y + 0.5));
      const bool round = bokeh == Bokeh::round;
      inside += round ? std::hypot(dx, dy) < radius
                      : std::max(dx, 0.5 * dx + std::sqrt(0.75) * dy) < std::sqrt(0.75) * radius;
    }
  const double area = bokeh == Bokeh::round ? std::numbers::pi : 1.5 * std::sqrt(3.0);
  return inside / (16.0 * side * side) / (area * radius * radius);
}

// A lamp of some pixels has a disc with an edge as soft as the lamp is wide: an overexposed one would show a hard edge.
// Hard case: dof.lamps
TEST_P(DofBokeh, spreads_a_lamp_of_some_pixels_as_each_of_them) {
  constexpr int kSide = 96, kFirst = 45;
  for (const Bokeh bokeh : {Bokeh::round, Bokeh::hexagonal})
    for (const bool full : {false, true})
      for (const int side : {2, 4, 7})
        for (const float circle : {9.0f, 14.0f, -9.0f, -14.0f}) {
          DofInput in(kSide, kSide, circle, vec4(0.0f, 0.0f, 0.0f, 1.0f));
          for (int y = kFirst; y < kFirst + side; ++y)
            for (int x = kFirst; x < kFirst + side; ++x)
              in.light[in.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))] = vec4(vec3(3000.0f), 1.0f);
          in.knobs.full_resolution = full;
          in.knobs.radius = 31.0f;
          in.bokeh = bokeh;
          const DofResult result = run(in);
          const double radius = std::abs(static_cast<double>(circle));
          const double most = square_through_lens(bokeh, radius, kFirst, side, 48, 48);
          double worst = 0.0;
          for (int y = 20; y < 76; ++y)
            for (int x = 20; x < 76; ++x) {
              const double shown =
                  static_cast<double>(
                      result.light[in.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))].x) /
                  3000.0 / (side * side);
              worst = std::max(worst, std::abs(shown - square_through_lens(bokeh, radius, kFirst, side, x, y)) / most);
            }
          EXPECT_LT(worst, 0.15) << (bokeh == Bokeh::round ? "round" : "hexagonal") << (full ? ", full" : ", half")
                                 << ", side " << side << ", circle " << circle;
        }
}

}  // namespace
}  // namespace gloam::test
