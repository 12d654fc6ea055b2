// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Blades against measures of real grass: how far the wind bends them, how they swing, and that no joint folds.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "modules/grass/growth/blade_types.h"
#include "modules/grass/reference/blade_solver.h"
#include "tests/modules/grass/support/blades.h"

namespace gloam::test {
namespace {

constexpr double kBendStep = 1.0 / 120.0;

std::vector<BladeType> types() { return builtin_blade_types(); }

BladeModel builtin_blade(const BladeType& type, float mean_m, float mean_width_m, float yaw) {
  const shaders::GrassTypeRow row = blade_type_row(type);
  GrassBlade blade;
  blade.length_m = mean_m * type.length_scale;
  blade.width_m = mean_width_m * type.width_scale;
  blade.yaw = yaw;
  return blade_model(blade, {&row, 1});
}

struct Lean {
  double lean_m = 0.0;    ///< mean way of the tip from where it stands in still air
  double sway_m = 0.0;    ///< range of it over time
  double sharpest = 0.0;  ///< greatest angle between segments, degrees
  double height_m = 0.0;  ///< mean of the tip
  double longest = 0.0;   ///< greatest relative error of a segment's length
};

double sharpest_angle(const BladeState& state) {
  double least = 1.0;
  for (std::size_t k = 2; k < kGrassKnots; ++k)
    least = std::min(least, glm::dot(glm::normalize(state.at[k] - state.at[k - 1]),
                                     glm::normalize(state.at[k - 1] - state.at[k - 2])));
  return std::acos(std::clamp(least, -1.0, 1.0)) * 57.29577951308232;
}

/// Runs a blade in the wind from rest for some seconds and measures the last ones.
Lean lean_of(const BladeModel& blade, double speed, double gust, double step_s, double at_x) {
  BladeSteps frame;
  frame.step_s = step_s;
  frame.iterations = 3;
  BladeState still = rest_state(blade);
  const int settle = static_cast<int>(8.0 / step_s), measured = static_cast<int>(8.0 / step_s);
  for (int i = 0; i < settle; ++i) advance_blade(blade, frame, 1, still);
  const Wind wind{vec3(static_cast<float>(speed), 0.0f, 0.0f), static_cast<float>(gust)};
  frame.wind_at = dvec3(at_x, 0.0, 3.0);
  BladeState state = still;
  Lean lean;
  KnotFaults faults;
  double least = 1e9, most = -1e9;
  for (int i = 0; i < settle + measured; ++i) {
    frame.wind = wind_at_step(&wind, static_cast<std::uint32_t>(i), step_s);
    advance_blade(blade, frame, 1, state);
    lean.sharpest = std::max(lean.sharpest, sharpest_angle(state));
    faults.add(blade, state.at);
    if (i < settle) continue;
    const dvec3 way = state.at[15] - still.at[15];
    lean.lean_m += glm::length(way) / measured;
    lean.height_m += state.at[15].y / measured;
    least = std::min(least, way.x);
    most = std::max(most, way.x);
  }
  lean.sway_m = most - least;
  lean.longest = faults.longest;
  EXPECT_TRUE(faults.finite);
  return lean;
}

/// Mean over the built-in types, by their shares, and yaws.
Lean mean_lean(float length_m, float width_m, double speed, double step_s = kBendStep) {
  Lean mean;
  double shares = 0.0;
  for (const BladeType& type : types())
    for (int yaw = 0; yaw < 4; ++yaw) {
      const BladeModel blade = builtin_blade(type, length_m, width_m, 0.3f + 1.57f * static_cast<float>(yaw));
      const Lean lean = lean_of(blade, speed, 0.4, step_s, 17.0 * yaw);
      const double share = static_cast<double>(type.share);
      shares += share;
      mean.lean_m += share * lean.lean_m;
      mean.sway_m += share * lean.sway_m;
      mean.height_m += share * lean.height_m;
      mean.sharpest = std::max(mean.sharpest, lean.sharpest);
      mean.longest = std::max(mean.longest, lean.longest);
    }
  mean.lean_m /= shares;
  mean.sway_m /= shares;
  mean.height_m /= shares;
  return mean;
}

struct Swing {
  double frequency = 0.0;  ///< 1/s
  double decay_s = 0.0;    ///< until the swing stays within a twentieth of its first reach
};

/// Bends the blade by a steady wind, lets it go, and follows the tip along the wind.
Swing swing_of(const BladeModel& blade, double step_s) {
  BladeSteps frame;
  frame.step_s = step_s;
  BladeState still = rest_state(blade), state = still;
  for (int i = 0; i < static_cast<int>(10.0 / step_s); ++i) {
    frame.wind = {};
    advance_blade(blade, frame, 1, still);
    frame.wind = {dvec3(5.0, 0.0, 0.0), 0.0, dvec3(0.0)};
    advance_blade(blade, frame, 1, state);
  }
  frame.wind = {};
  const dvec3 aside = glm::normalize(state.at[15] - still.at[15]);
  const double reach = glm::length(state.at[15] - still.at[15]);
  std::vector<double> crossings;
  double before = reach;
  Swing swing;
  for (int i = 1; i <= static_cast<int>(8.0 / step_s); ++i) {
    advance_blade(blade, frame, 1, state);
    const double now = glm::dot(state.at[15] - still.at[15], aside);
    if (std::abs(now) > 0.05 * reach) swing.decay_s = i * step_s;
    if ((now > 0.0) != (before > 0.0) && std::abs(now - before) > 1e-7)
      crossings.push_back((i - 1 + before / (before - now)) * step_s);
    before = now;
  }
  const std::size_t used = std::min<std::size_t>(crossings.size(), 4);
  if (used >= 2) swing.frequency = 0.5 * static_cast<double>(used - 1) / (crossings[used - 1] - crossings[0]);
  return swing;
}

constexpr double kLengths[] = {0.1, 0.3, 1.0};
constexpr double kWinds[] = {3.0, 8.0, 15.0};

TEST(Bending, wind_bends_blades_as_it_bends_grass) {
  Lean leans[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      Lean& lean = leans[i][j] = mean_lean(static_cast<float>(kLengths[i]), 0.006f, kWinds[j]);
      std::printf("%.1f m, %2.0f m/s: leans by %.1f cm, sways by %.1f cm, sharpest angle %.0f degrees\n", kLengths[i],
                  kWinds[j], 100.0 * lean.lean_m, 100.0 * lean.sway_m, lean.sharpest);
      EXPECT_LE(lean.sharpest, 60.0) << kLengths[i] << " m, " << kWinds[j] << " m/s";
      EXPECT_LE(lean.longest, 0.01) << kLengths[i] << " m, " << kWinds[j] << " m/s";
      if (j > 0) {
        EXPECT_GT(lean.lean_m, 1.2 * leans[i][j - 1].lean_m) << kLengths[i] << " m, " << kWinds[j] << " m/s";
      }
      if (i > 0) {
        EXPECT_GE(lean.lean_m, kLengths[i] / kLengths[i - 1] * leans[i - 1][j].lean_m) << kWinds[j] << " m/s";
      }
    }
  EXPECT_GE(leans[1][1].lean_m, 0.05) << "0.3 m at 8 m/s";
  EXPECT_LE(leans[1][1].lean_m, 0.15) << "0.3 m at 8 m/s";
  EXPECT_GT(leans[1][1].sway_m, 0.02) << "gusts are seen";
}

TEST(Bending, short_blades_lean_by_the_fourth_power_of_their_length_and_wide_ones_less) {
  const BladeType straight = {.stiffness = 0.3f, .points = {{0, 0}, {0, 1}}};
  const auto lean = [&](float length_m, float width_m) {
    return lean_of(builtin_blade(straight, length_m, width_m, 0.0f), 2.0, 0.0, kBendStep, 0.0).lean_m;
  };
  const double power = std::log(lean(0.2f, 0.006f) / lean(0.1f, 0.006f)) / std::log(2.0);
  EXPECT_NEAR(power, 4.0, 0.35);
  EXPECT_LT(lean(0.2f, 0.012f), 0.25 * lean(0.2f, 0.006f)) << "wider is thicker";
}

TEST(Bending, a_blade_let_go_swings_once_to_three_times_a_second_and_comes_to_rest_at_any_frame_rate) {
  for (const BladeType& type : types()) {
    const BladeModel blade = builtin_blade(type, 0.3f, 0.006f, 0.3f);
    const Swing expected = swing_of(blade, kBendStep / 8.0);
    for (const double step : {1.0 / 144.0, kBendStep, 1.0 / 60.0}) {
      SCOPED_TRACE(testing::Message() << type.name << ", steps of " << step << " s");
      const Swing swing = swing_of(blade, step);
      std::printf("%s, %.4f s: %.2f swings a second, at rest after %.2f s\n", type.name.c_str(), step, swing.frequency,
                  swing.decay_s);
      EXPECT_GE(swing.frequency, 1.0);
      EXPECT_LE(swing.frequency, 3.0);
      EXPECT_GE(swing.decay_s, 1.0);
      EXPECT_LE(swing.decay_s, 3.0);
      EXPECT_NEAR(swing.frequency, expected.frequency, 0.06 * expected.frequency);
    }
  }
}

TEST(Bending, damping_decides_how_long_a_blade_swings) {
  BladeModel blade = builtin_blade(types()[0], 0.3f, 0.006f, 0.3f);
  blade.damping = 1.5;
  const double usual_s = swing_of(blade, kBendStep).decay_s;
  blade.damping = 5.0;
  EXPECT_LT(swing_of(blade, kBendStep).decay_s, 0.5 * usual_s);
}

TEST(Bending, gusts_are_seen_travelling_over_the_tips) {
  // Two rows of like blades, 4 m apart along the wind: the second does what the first did 4 m over 8 m/s earlier.
  const BladeModel blade = builtin_blade(types()[0], 0.3f, 0.006f, 0.3f);
  const Wind wind{vec3(8.0f, 0.0f, 0.0f), 0.5f};
  std::vector<double> tips[2];
  for (int row = 0; row < 2; ++row) {
    BladeState state = rest_state(blade);
    BladeSteps frame;
    frame.wind_at = dvec3(100.0 + 4.0 * row, 0.0, 30.0);
    for (int i = 0; i < 3600; ++i) {
      frame.wind = wind_at_step(&wind, static_cast<std::uint32_t>(i), frame.step_s);
      advance_blade(blade, frame, 1, state);
      if (i >= 600) tips[row].push_back(state.at[15].x);
    }
  }
  const auto correlation = [&](int delay) {
    const std::size_t count = tips[0].size() - 240;
    double a = 0.0, b = 0.0, ab = 0.0, aa = 0.0, bb = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = tips[0][i], y = tips[1][i + static_cast<std::size_t>(delay)];
      a += x;
      b += y;
      ab += x * y;
      aa += x * x;
      bb += y * y;
    }
    const auto n = static_cast<double>(count);
    return (ab - a * b / n) / std::sqrt((aa - a * a / n) * (bb - b * b / n));
  };
  int best = 0;
  for (int delay = 0; delay < 240; ++delay)
    if (correlation(delay) > correlation(best)) best = delay;
  EXPECT_NEAR(best, 60, 6) << "steps";
  EXPECT_GT(correlation(best), 0.9);
  EXPECT_LT(correlation(0), 0.5);
}

TEST(Bending, steps_of_no_time_and_of_a_second_explode_nothing) {
  for (const double step : {0.0, 1e-6, 0.1, 1.0, 10.0})
    for (const BladeType& type : types()) {
      SCOPED_TRACE(testing::Message() << type.name << ", steps of " << step << " s");
      const BladeModel blade = builtin_blade(type, 0.3f, 0.006f, 0.3f);
      BladeState state = rest_state(blade);
      KnotFaults faults;
      BladeSteps frame;
      frame.step_s = std::max(step, 1e-9);
      frame.wind = {dvec3(12.0, 0.0, 3.0), 0.0, dvec3(0.0)};
      for (int i = 0; i < 200; ++i) {
        advance_blade(blade, frame, 1, state);
        faults.add(blade, state.at);
      }
      EXPECT_TRUE(faults.finite);
      EXPECT_LE(faults.longest, 1e-6);
      EXPECT_LE(faults.deepest_m, 1e-9);
    }
}

}  // namespace
}  // namespace gloam::test
