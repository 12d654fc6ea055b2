// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/bench/grass/case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <vector>

#include "modules/grass/growth/blade_rows.h"
#include "modules/grass/simulation/wind.h"
#include "sandbox/bench/grass/tips.h"

namespace gloam {
namespace {

TEST(DistanceOfLive, is_the_end_of_the_last_key_with_few_enough_blades) {
  std::vector<std::uint32_t> bins(257, 30);
  bins[0] = 0;
  bins[1] = 10;
  bins[2] = 20;
  EXPECT_DOUBLE_EQ(distance_of_live(bins, 255.0, 9), 0.0);
  EXPECT_DOUBLE_EQ(distance_of_live(bins, 255.0, 10), 1.0);
  EXPECT_DOUBLE_EQ(distance_of_live(bins, 255.0, 29), 2.0);
  EXPECT_DOUBLE_EQ(distance_of_live(bins, 255.0, 30), 255.0);
}

TEST(Averaged, takes_the_mean_of_each_square) {
  LinearPicture picture{.width = 4, .height = 2, .rgba = {}};
  for (int i = 0; i < 8; ++i)
    for (int c = 0; c < 4; ++c) picture.rgba.push_back(static_cast<float>(i + c));
  const LinearPicture small = averaged(picture, 2);
  EXPECT_EQ(small.width, 2u);
  EXPECT_EQ(small.height, 1u);
  EXPECT_EQ(small.rgba, (std::vector<float>{2.5f, 3.5f, 4.5f, 5.5f, 4.5f, 5.5f, 6.5f, 7.5f}));
}

/// A patch of one master and one slave at rest, both live, the slave first.
struct TwoBlades {
  GrassField field;
  GrassReading reading;

  TwoBlades() {
    GrassPatch patch;
    patch.roots = {vec3(-1.0f), vec3(1.0f)};
    patch.blades = 2;
    patch.masters = 1;
    field.patches = {patch};
    field.blades.resize(GLOAM_GRASS_PATCH_BLADES);
    field.blades[1] = {.root_m = vec3(0.5f, 0.0f, 0.25f), .yaw = 1.0f, .length_m = 0.4f, .slot = 1, .master = 0};
    shaders::GrassTypeRow type{};
    for (int k = 0; k < GLOAM_GRASS_KNOTS; ++k) type.stem[k] = vec2(0.0f, static_cast<float>(k) / 15.0f);
    type.stiffness = 0.5f;
    field.types = {type};
    reading.patches = {{.patch = 0, .slot = 0}};
    reading.blades = {1, 0};
    reading.draws.live = 2;
    const dvec3 root = tip_of_row(0).model.root;
    for (int k = 0; k < GLOAM_GRASS_KNOTS; ++k)
      reading.knots.emplace_back(vec3(root) + vec3(0.0f, 0.02f * static_cast<float>(k), 0.0f), 0.0f);
    reading.poses = {scaled(0.4f / 0.3f), scaled(1.0f)};
  }
  [[nodiscard]] DrawnTip tip_of_row(std::size_t slot) const {
    shaders::GrassPatchRow row{};
    row.box_from = field.patches[0].roots.min;
    row.box_size = field.patches[0].roots.max - row.box_from;
    return {.model = blade_model(row, pack_blade_row(field.blades[slot], field.patches[0]), field.types)};
  }
  static shaders::GrassPose scaled(float by) {
    shaders::GrassPose pose{};
    pose.row0 = vec4(by, 0.0f, 0.0f, 7.0f);  // the translation has no effect
    pose.row1 = vec4(0.0f, by, 0.0f, 7.0f);
    pose.row2 = vec4(0.0f, 0.0f, by, 7.0f);
    return pose;
  }
};

TEST(DrawnTips, are_turned_knots_relative_to_the_root) {
  const TwoBlades two;
  const std::vector<DrawnTip> tips = drawn_tips(two.field, two.reading, TipChoice::all, 10);
  ASSERT_EQ(tips.size(), 2u);
  EXPECT_FALSE(tips[0].master);
  EXPECT_TRUE(tips[1].master);
  EXPECT_NEAR(tips[0].tip.y, 0.4, 1e-6);
  EXPECT_NEAR(tips[1].tip.y, 0.3, 1e-6);
  EXPECT_NEAR(tips[0].model.root.x, 0.5, 1e-4);
  EXPECT_NEAR(tips[0].model.length_m, 0.4, 1e-3);
  EXPECT_EQ(drawn_tips(two.field, two.reading, TipChoice::masters, 10).size(), 1u);
  EXPECT_EQ(drawn_tips(two.field, two.reading, TipChoice::all, 1).size(), 1u);
  EXPECT_NE(hash_of_tips(tips), hash_of_tips(std::span(tips).first(1)));
}

TEST(SimulatedTips, are_those_of_the_blade_solver_for_any_executor) {
  const TwoBlades two;
  const std::vector<DrawnTip> drawn = drawn_tips(two.field, two.reading, TipChoice::all, 10);
  const Wind wind{.velocity = vec3(3.0f, 0.0f, 1.0f)};
  std::vector<shaders::GrassSteps> frames;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    shaders::GrassSteps steps{};
    steps.wind = to_shader(wind_at_step(&wind, 4 * frame, 1.0 / 120.0));
    steps.step_s = 1.0f / 120.0f;
    steps.frame_steps = 4;
    frames.push_back(steps);
  }
  const auto serial = make_serial_executor(), pool = make_pool_executor(3);
  const std::vector<dvec3> tips = simulated_tips(drawn, frames, {.iterations = 5}, *serial);
  EXPECT_EQ(tips, simulated_tips(drawn, frames, {.iterations = 5}, *pool));
  BladeState state = rest_state(drawn[0].model);
  for (const shaders::GrassSteps& frame : frames) {
    BladeSteps steps;
    steps.wind = from_shader(frame.wind);
    steps.wind_at = drawn[0].wind_at;
    steps.step_s = double{frame.step_s};
    steps.frame_steps = 4;
    steps.iterations = 5;
    advance_blade(drawn[0].model, steps, 4, state);
  }
  EXPECT_EQ(tips[0], state.at[kGrassKnots - 1]);
  EXPECT_GT(glm::length(tips[0] - drawn[0].tip), 1e-4);  // the wind has moved it
  // Shorter steps of the same time lead to nearly the same place.
  const std::vector<dvec3> finer = simulated_tips(drawn, frames, {.iterations = 5, .step_parts = 4}, *serial);
  EXPECT_LT(glm::length(finer[0] - tips[0]), 0.01);
}

TEST(TipError, is_in_millimetres) {
  std::vector<DrawnTip> drawn(2);
  drawn[1].tip = dvec3(0.0, 0.003, 0.004);
  drawn[0].model.rest[kGrassKnots - 1] = dvec3(0.0, 0.001, 0.0);
  const ErrorStatistics error = tip_error_mm(std::vector<dvec3>(2), tips_of(drawn));
  EXPECT_NEAR(error.mean, 2.5, 1e-6);
  EXPECT_NEAR(error.max, 5.0, 1e-6);
  EXPECT_NEAR(tip_error_mm(rest_tips(drawn), std::vector<dvec3>(2)).mean, 0.5, 1e-6);
}

TEST(GrassTimes, counts_each_pass_of_the_module_once) {
  FrameSample sample;
  double ms = 1.0;
  for (const char* pass : {"grass_keys", "grass_live", "grass_masters", "grass_sort_count", "grass_sort_scatter",
                           "grass_simulation", "grass_poses", "grass_blades", "grass_upload"}) {
    sample.report.passes.push_back({.name = pass, .module = "grass", .ms = ms});
    ms *= 2.0;
  }
  sample.report.passes.push_back({.name = "geometry", .module = "engine", .ms = 1000.0});
  const GrassTimes times = grass_times(sample);
  EXPECT_DOUBLE_EQ(times.lod_ns, 7e6);
  EXPECT_DOUBLE_EQ(times.sort_ns, 24e6);
  EXPECT_DOUBLE_EQ(times.simulation_ns, 32e6);
  EXPECT_DOUBLE_EQ(times.drawing_ns, 192e6);
  EXPECT_DOUBLE_EQ(times.all_ns(), 255e6);
}

}  // namespace
}  // namespace gloam
