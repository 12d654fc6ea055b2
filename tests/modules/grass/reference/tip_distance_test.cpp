// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/reference/tip_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "modules/grass/reference/slave_pose.h"
#include "modules/grass/simulation/steps.h"
#include "modules/grass/simulation/wind.h"
#include "tests/jobs/executors.h"
#include "tests/modules/grass/growth/lawns.h"

namespace gloam::test {
namespace {

/// A small lawn in a gusty wind.
class TipDistance : public ::testing::Test {
 protected:
  [[nodiscard]] GrassField lawn_with(std::uint32_t slaves, double density = 6.0) const {
    const Mesh mesh = lawn(2, 4.0f, &hills);
    GrassSurface surface;
    surface.density = static_cast<float>(density);
    const std::vector<GrassSource> sources = {
        {.entity = Entity{}, .surface = surface, .mesh = &mesh, .types_file = {}}};
    GrassField field;
    grow_grass(sources, {.slaves_per_master = slaves}, *make_serial_executor(), field);
    return field;
  }
  [[nodiscard]] std::vector<double> distances(const GrassField& field, std::uint32_t iterations,
                                              TipConditions conditions) const {
    std::vector<std::uint32_t> patches(field.patches.size());
    std::iota(patches.begin(), patches.end(), 0u);
    return tip_distances(field, patches, conditions, iterations, *make_serial_executor());
  }
  [[nodiscard]] TipConditions windy() const {
    return {.wind = &wind_, .first_step = 77, .steps = 60, .colliders = {}, .most_blades = 24};
  }
  static double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }
  const Wind wind_{.velocity = vec3(4.0f, 0.0f, 1.0f), .gust = 0.6f};
};

/// Frame by frame, as the program runs; the wind is asked anew in each.
BladeState frame_by_frame(const GrassField& field, const GrassBlade& blade, const Wind& wind, std::uint32_t first,
                          std::uint32_t steps, std::uint32_t parts, std::uint32_t iterations) {
  const BladeModel model = blade_model(blade, field.types);
  BladeState state = rest_state(model);
  const GrassPatch& patch = field.patches[blade.slot / GLOAM_GRASS_PATCH_BLADES];
  for (std::uint32_t step = 0; step < steps; ++step)
    advance_blade(model,
                  {.wind = wind_at_step(&wind, first + step, kGrassStep),
                   .wind_at = wind_position(patch.origin),
                   .step_s = kGrassStep / parts,
                   .frame_steps = parts,
                   .iterations = iterations,
                   .colliders = {}},
                  parts, state);
  return state;
}

TEST_F(TipDistance, is_that_of_blades_that_are_run_frame_by_frame) {
  const GrassField field = lawn_with(2);
  TipConditions conditions = windy();
  conditions.steps = 30;
  conditions.most_blades = 512;
  const std::vector<double> found = distances(field, 3, conditions);
  ASSERT_EQ(found.size(), std::min(field.statistics.blades, 512u));
  constexpr std::size_t kTip = kGrassKnots - 1;
  std::size_t at = 0, slaves = 0;
  for (const GrassBlade& blade : field.blades) {
    if (blade.length_m <= 0.0f) continue;
    const std::size_t i = at++;
    if (i % 8 != 7) continue;
    const dvec3 fine = frame_by_frame(field, blade, wind_, 77, 30, kTrueStepParts, kTrueIterations).at[kTip];
    const GrassBlade& master = field.blades[blade.master];
    const BladeState coarse = frame_by_frame(field, master, wind_, 77, 30, 1, 3);
    dvec3 shown = coarse.at[kTip];
    if (blade.master != blade.slot) {
      const auto stem = [](const GrassBlade& one) {
        return SlaveStem{dvec3(one.ground_normal), static_cast<double>(one.yaw), static_cast<double>(one.length_m)};
      };
      const double speed = 120.0 * glm::length(coarse.at[kTip] - coarse.before[kTip]);
      shown = slave_knot(slave_turn(stem(master), stem(blade), blade.slot % 256, shown,
                                    blade_model(master, field.types).rest[kTip], speed),
                         shown);
      ++slaves;
    }
    EXPECT_NEAR(found[i], glm::length(fine - shown), 1e-4) << i;
  }
  EXPECT_GT(slaves, 3u);
  EXPECT_LT(slaves, at / 8);
}

TEST_F(TipDistance, falls_with_iterations_and_is_not_zero) {
  const GrassField field = lawn_with(0);
  std::vector<double> errors;
  for (const std::uint32_t iterations : {1u, 3u, 8u}) errors.push_back(mean(distances(field, iterations, windy())));
  EXPECT_GT(errors[0], errors[1]);
  EXPECT_GT(errors[1], errors[2]);
  EXPECT_GT(errors[2], 1e-6) << "steps an eighth as long make a difference";
  EXPECT_LT(errors[0], 0.3) << "no further than a blade is long";
}

TEST_F(TipDistance, grows_with_slaves) {
  const double masters = mean(distances(lawn_with(0), 8, windy()));
  const double slaves = mean(distances(lawn_with(16), 8, windy()));
  EXPECT_GT(slaves, 2.0 * masters);
  EXPECT_LT(slaves, 0.3);
}

TEST_F(TipDistance, needs_no_wind_and_no_more_blades_than_there_are) {
  const GrassField field = lawn_with(4, 0.2);
  const std::vector<double> still = distances(field, 3, {.steps = 20, .most_blades = 1000});
  EXPECT_EQ(still.size(), field.statistics.blades);
  for (const double distance : still) EXPECT_TRUE(std::isfinite(distance));
  EXPECT_TRUE(distances(GrassField(), 3, {}).empty());
}

TEST_F(TipDistance, compares_blades_of_all_patches_and_is_the_same_with_threads) {
  const GrassField field = lawn_with(4, 60.0);
  ASSERT_GT(field.patches.size(), 2u);
  std::vector<std::uint32_t> patches(field.patches.size());
  std::iota(patches.begin(), patches.end(), 0u);
  TipConditions conditions = windy();
  conditions.steps = 8;
  conditions.most_blades = 8;
  const std::vector<double> serial = tip_distances(field, patches, conditions, 3, *make_serial_executor());
  EXPECT_EQ(serial.size(), 8u);
  conditions.most_blades = 1u << 20;
  const std::vector<double> all =
      tip_distances(field, patches, {.steps = 1, .most_blades = 1u << 20}, 3, *make_serial_executor());
  EXPECT_EQ(all.size(), field.statistics.blades);
  conditions.most_blades = 8;
  for (const ExecutorCase& one : all_executors())
    EXPECT_EQ(tip_distances(field, patches, conditions, 3, *one.make()), serial) << one.name;
}

TEST_F(TipDistance, a_collider_that_stays_pushes_both_alike) {
  const GrassField field = lawn_with(0, 3.0);
  PlacedCollider ball;
  ball.from = ball.to = dvec3(0.0, 0.3, 0.0);
  ball.from_previous = ball.to_previous = dvec3(50.0, 0.3, 0.0);  // it has come a long way: that must not count
  ball.radius_m = 1.5;
  ball.low = dvec3(-2.0);
  ball.high = dvec3(60.0, 2.0, 2.0);
  const std::vector<PlacedCollider> colliders = {ball};
  TipConditions conditions = windy();
  conditions.colliders = colliders;
  const double pushed = mean(distances(field, 8, conditions));
  EXPECT_NE(pushed, mean(distances(field, 8, windy()))) << "it touches some";
  std::vector<PlacedCollider> at_rest = colliders;
  at_rest[0].from_previous = at_rest[0].to_previous = at_rest[0].from;
  conditions.colliders = at_rest;
  EXPECT_EQ(pushed, mean(distances(field, 8, conditions)));
}

}  // namespace
}  // namespace gloam::test
