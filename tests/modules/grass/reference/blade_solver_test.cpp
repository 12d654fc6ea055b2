// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/reference/blade_solver.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/jobs/executors.h"
#include "tests/modules/grass/support/blades.h"
#include "tests/support/scale.h"
#include "tests/support/worse.h"

namespace gloam::test {
namespace {

BladeModel blade_of(float stiffness, float length_m = 0.3f, vec3 normal = vec3(0.0f, 1.0f, 0.0f), float yaw = 0.0f) {
  const shaders::GrassTypeRow type = leaning_type(stiffness);
  GrassBlade blade;
  blade.length_m = length_m;
  blade.ground_normal = glm::normalize(normal);
  blade.yaw = yaw;
  return blade_model(blade, {&type, 1});
}

/// A blade that lies on the ground in a direction off its lean.
BladeState pressed_flat(const BladeModel& blade) {
  BladeState state;
  const dvec3 aside = glm::cross(blade.normal, blade.forward);
  for (std::size_t k = 1; k < kGrassKnots; ++k)
    state.at[k] = state.at[k - 1] + aside * glm::length(blade.rest[k] - blade.rest[k - 1]);
  state.before = state.at;
  return state;
}

double distance(const BladeState& a, const BladeState& b) {
  double most = 0.0;
  for (std::size_t k = 0; k < kGrassKnots; ++k) most = worse(most, glm::length(a.at[k] - b.at[k]));
  return most;
}

void expect_sound(const BladeModel& blade, const BladeState& state) {
  KnotFaults faults;
  faults.add(blade, state.at);
  EXPECT_TRUE(faults.finite);
  EXPECT_LE(faults.longest, 1e-6);
  EXPECT_LE(faults.deepest_m, 1e-9);
  EXPECT_EQ(faults.root_m, 0.0);
}

TEST(BladeSolver, knots_at_rest_follow_the_type_yaw_and_normal) {
  const BladeModel flat = blade_of(0.1f, 0.5f, vec3(0.0f, 1.0f, 0.0f), 0.5f * kPi);
  EXPECT_LT(glm::length(flat.rest[15] - dvec3(0.0, 0.475, -0.15)), 1e-7) << "yaw turns +X toward −Z";
  const BladeModel steep = blade_of(0.1f, 0.5f, vec3(1.0f, 1.0f, 0.2f), 1.3f);
  EXPECT_NEAR(glm::dot(steep.forward, steep.normal), 0.0, 1e-7);
  EXPECT_NEAR(glm::length(steep.forward), 1.0, 1e-7);
  EXPECT_NEAR(glm::dot(steep.rest[15], steep.normal), 0.475, 1e-7);
}

TEST(BladeSolver, a_stiff_blade_stands_and_a_limp_one_falls) {
  BladeSteps frame;
  frame.frame_steps = 600;
  const BladeModel stiff = blade_of(1.0f);
  BladeState state = rest_state(stiff);
  advance_blade(stiff, frame, 600, state);
  EXPECT_LT(distance(state, rest_state(stiff)), 0.001);
  const BladeModel limp = blade_of(0.0f);
  state = rest_state(limp);
  advance_blade(limp, frame, 600, state);
  EXPECT_LT(state.at[15].y, 0.01);
  expect_sound(limp, state);
}

TEST(BladeSolver, a_blade_pressed_flat_stands_up_again) {
  for (const float stiffness : {0.1f, 0.2f, 0.4f, 0.8f, 1.0f})
    for (const std::uint32_t iterations : {1u, 2u, 3u, 8u}) {
      const BladeModel blade = blade_of(stiffness);
      BladeSteps frame;
      frame.iterations = iterations;
      frame.frame_steps = 2000;
      BladeState still = rest_state(blade);
      advance_blade(blade, frame, 2000, still);
      frame.frame_steps = 480;
      BladeState pressed = pressed_flat(blade);
      EXPECT_GT(distance(pressed, still), 0.1);
      advance_blade(blade, frame, 480, pressed);
      EXPECT_LT(distance(pressed, still), 0.003) << stiffness << ", " << iterations << " iterations";
    }
}

TEST(BladeSolver, gusts_sway_a_blade_visibly) {
  const BladeModel blade = blade_of(0.25f);
  const Wind wind{vec3(5.0f, 0.0f, 0.0f), 0.5f};
  BladeState state = rest_state(blade);
  double least = 1.0, most = 0.0;
  for (std::uint32_t step = 0; step < 1200; ++step) {
    BladeSteps frame;
    frame.wind = wind_at_step(&wind, step, frame.step_s);
    advance_blade(blade, frame, 1, state);
    if (step < 300) continue;
    least = std::min(least, state.at[15].x);
    most = std::max(most, state.at[15].x);
  }
  EXPECT_GT(least, blade.rest[15].x + 0.03) << "the wind bends it";
  EXPECT_GT(most - least, 0.02) << "gusts move its tip";
}

/// Poses that no wind leads to: random directions, then one step that restores lengths and ground.
BladeState random_pose(const BladeModel& blade, const BladeSteps& frame, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  BladeState state;
  dvec3 direction(unit(random), unit(random) + 0.5, unit(random));
  for (std::size_t k = 1; k < kGrassKnots; ++k) {
    direction += 0.5 * dvec3(unit(random), unit(random), unit(random));
    state.at[k] = state.at[k - 1] + glm::normalize(direction) * glm::length(blade.rest[k] - blade.rest[k - 1]);
  }
  state.before = state.at;
  advance_blade(blade, frame, 1, state);
  state.before = state.at;
  return state;
}

// Hard case: grass.wind_0, grass.energy
TEST(BladeSolver, ten_thousand_steps_without_wind_gain_no_energy) {
  std::mt19937 random(1);
  for (const float stiffness : {0.0f, 0.02f, 0.1f, 0.5f, 1.0f})
    for (const std::uint32_t iterations : {1u, 3u, 8u}) {
      SCOPED_TRACE(testing::Message() << stiffness << ", " << iterations << " iterations");
      const BladeModel blade = blade_of(stiffness);
      BladeSteps frame;
      frame.iterations = iterations;
      BladeState state = rest_state(blade);
      const double begin = blade_energy(blade, state, frame.step_s);
      for (int step = 0; step < 10000; ++step) {
        advance_blade(blade, frame, 1, state);
        ASSERT_LE(blade_energy(blade, state, frame.step_s), 1.05 * begin) << step;
      }
      expect_sound(blade, state);
      const BladeState still = state;
      state = random_pose(blade, frame, random);
      for (int step = 0; step < 10000; ++step) advance_blade(blade, frame, 1, state);
      expect_sound(blade, state);
      double speed = 0.0;
      for (std::size_t k = 0; k < kGrassKnots; ++k)
        speed = std::max(speed, glm::length(state.at[k] - state.before[k]) / frame.step_s);
      EXPECT_LT(speed, 1e-3) << "it comes to rest";
      if (stiffness >= 0.1f) {
        EXPECT_LT(distance(state, still), 1e-6) << "in the one pose of rest";
      }
    }
}

TEST(BladeSolver, shorter_steps_and_more_iterations_converge) {
  const BladeModel blade = blade_of(0.1f);
  const Wind wind{vec3(4.0f, 0.0f, 2.0f), 0.5f};
  const auto mean_error = [&](std::uint32_t iterations, int divided, std::uint32_t other, int other_divided) {
    const auto path = [&](std::uint32_t count, int part) {
      std::vector<dvec3> tips;
      BladeState state = rest_state(blade);
      BladeSteps frame;
      frame.iterations = count;
      frame.step_s = 1.0 / 120.0 / part;
      for (int step = 0; step < 480 * part; ++step) {
        frame.wind = wind_at_step(&wind, static_cast<std::uint32_t>(step), frame.step_s);
        advance_blade(blade, frame, 1, state);
        if (step % part == part - 1) tips.push_back(state.at[15]);
      }
      return tips;
    };
    const std::vector<dvec3> a = path(iterations, divided), b = path(other, other_divided);
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += glm::length(a[i] - b[i]);
    return sum / static_cast<double>(a.size());
  };
  std::vector<double> errors;
  std::printf("mean distance of the tip from 64 iterations at dt/8:");
  for (const std::uint32_t iterations : {1u, 2u, 3u, 4u, 6u, 8u, 64u}) {
    errors.push_back(mean_error(iterations, 1, 64, 8));
    std::printf(" %u: %.2f mm", iterations, 1e3 * errors.back());
  }
  std::printf("\n");
  EXPECT_LT(errors[1], errors[0]) << "the second iteration helps";
  EXPECT_LT(errors[2], 0.0015) << "3 iterations";
  EXPECT_LT(mean_error(3, 4, 64, 8), 0.5 * errors[2]) << "and so do shorter steps";
  EXPECT_LT(mean_error(64, 4, 64, 8), 0.5 * errors.back());
}

// Hard case: grass.threads
TEST(BladeSolver, any_number_of_threads_gives_the_same_knots) {
  std::vector<BladeModel> blades;
  for (int i = 0; i < 333; ++i)
    blades.push_back(blade_of(0.001f * static_cast<float>(i), 0.3f, vec3(0.1f, 1.0f, 0.2f)));
  BladeSteps frame;
  frame.frame_steps = 8;
  frame.wind = {dvec3(5.0, 0.0, 1.0), 0.4, dvec3(0.0)};
  std::vector<BladeState> first;
  for (const ExecutorCase& executor : all_executors()) {
    std::vector<BladeState> states;
    for (const BladeModel& blade : blades) states.push_back(rest_state(blade));
    advance_blades(blades, frame, *executor.make(), states);
    if (first.empty()) first = states;
    for (std::size_t i = 0; i < states.size(); ++i) ASSERT_EQ(states[i].at, first[i].at);
  }
}

TEST(BladeSolver, a_blade_that_returns_does_the_frame_s_last_steps) {
  const BladeModel blade = blade_of(0.1f);
  BladeSteps frame;
  frame.frame_steps = 5;
  frame.wind = {dvec3(50.0, 0.0, 1.0), 1.0, dvec3(10.0)};
  BladeState late = rest_state(blade);
  advance_blade(blade, frame, 2, late);
  BladeState parts = rest_state(blade);
  frame.wind.drift += frame.wind.velocity * (3.0 * frame.step_s);
  frame.frame_steps = 2;
  advance_blade(blade, frame, 9, parts);
  EXPECT_LT(distance(late, parts), 1e-9);
}

}  // namespace
}  // namespace gloam::test
