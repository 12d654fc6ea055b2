// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <vector>

#include "modules/grass/reference/kernel_checks.h"
#include "tests/modules/grass/support/simulate_kernel.h"

namespace gloam::test {
namespace {

/// Distance of the kernel's knots from the twin's after some steps: rounding, and the device's exp, pow, sin and cos.
constexpr double kBound_m = 5e-5;

class GrassSimulation : public KernelTest {
 protected:
  [[nodiscard]] static GrassInput field(const std::vector<std::uint32_t>& patches, const std::vector<float>& stiffness,
                                        vec3 wind) {
    GrassInput input;
    for (const float s : stiffness) input.types.push_back(leaning_type(s));
    std::uint32_t seed = 1;
    for (const std::uint32_t count : patches) add_patch(input, count, seed++);
    input.steps.wind = {wind, 0.5f, vec3(3.0f, 0.0f, 200.0f)};
    return input;
  }
};

// Hard case: selftest.blades
TEST_F(GrassSimulation, a_step_moves_the_knots_as_the_twin_does) {
  for (const std::uint32_t iterations : {1u, 3u, 8u, 64u}) {
    SCOPED_TRACE(iterations);
    GrassInput input = field({100, 33}, {0.05f, 0.1f, 0.2f, 0.7f, 1.0f, 0.0f}, vec3(6.0f, 0.5f, -3.0f));
    input.steps.iterations = iterations;
    SimulateTwin twin(input);
    const SimulateKernel kernel(device());
    for (std::uint32_t frame = 0; frame < 6; ++frame) {
      input.steps.frame_steps = 1 + frame % 3;
      twin.advance(input.steps);
      kernel.advance(input, 1);
      EXPECT_LT(twin.distance(input.knots), kBound_m) << "frame " << frame;
      expect_sound(twin, input.knots);
    }
  }
}

TEST_F(GrassSimulation, knots_follow_the_twin_for_seconds) {
  GrassInput input = field({40}, {0.08f, 0.15f, 0.3f}, vec3(5.0f, 0.0f, 2.0f));
  SimulateTwin twin(input);
  const SimulateKernel kernel(device());
  input.steps.frame_steps = 4;
  for (int frame = 0; frame < 120; ++frame) {
    const shaders::GrassSteps steps = input.steps;
    twin.advance(steps);
    kernel.advance(input, 1);
    input.steps.wind.drift.x += 5.0f * 4.0f / 120.0f;
    // A blade that is bent flat may fall to either side of its curve, where rounding decides.
    ASSERT_GE(share_within(twin, input.knots, 1e-4), 0.9) << "frame " << frame;
    ASSERT_TRUE(std::isfinite(twin.distance(input.knots))) << "frame " << frame;
  }
  EXPECT_LT(twin.distance(input.knots), 2e-4);
}

TEST_F(GrassSimulation, a_far_master_runs_steps_of_its_stride_as_the_twin_does_and_may_change_it) {
  for (const std::uint32_t frame_steps : {1u, 4u, 8u}) {
    SCOPED_TRACE(frame_steps);
    GrassInput input = field({40}, {0.15f, 0.3f, 0.5f}, vec3(5.0f, 0.0f, 2.0f));
    SimulateTwin twin(input);
    const SimulateKernel kernel(device());
    input.steps.frame_steps = frame_steps;
    double path_s = 0.0;
    for (const std::uint32_t stride : {1u, 1u, 4u, 2u, 2u, 1u, 4u}) {
      for (shaders::GrassMaster& master : input.masters) master.stride = stride;
      shaders::GrassSteps steps = input.steps;
      const std::uint32_t turns = std::max(frame_steps / stride, 1u);
      const float before = static_cast<float>(frame_steps) - static_cast<float>(turns * stride);
      steps.wind.drift += steps.wind.velocity * (steps.step_s * before);
      steps.step_s *= static_cast<float>(stride);
      steps.frame_steps = turns;
      for (BladeState& state : twin.states)
        for (std::size_t k = 0; k < kGrassKnots; ++k)
          state.before[k] = state.at[k] - (state.at[k] - state.before[k]) * static_cast<double>(stride);
      twin.advance(steps);
      for (BladeState& state : twin.states)
        for (std::size_t k = 0; k < kGrassKnots; ++k)
          state.before[k] = state.at[k] - (state.at[k] - state.before[k]) / static_cast<double>(stride);
      // A master that waits for the steps of its stride runs them all in one frame.
      for (shaders::GrassMaster& master : input.masters)
        if (master.steps != GLOAM_GRASS_NO_STEP) master.steps = std::max(frame_steps, stride);
      kernel.advance(input, 1);
      path_s += static_cast<double>(steps.step_s) * turns;
      EXPECT_GE(share_within(twin, input.knots, 1e-4), 0.95) << "after " << path_s << " s, stride " << stride;
      expect_sound(twin, input.knots);
    }
  }
}

TEST_F(GrassSimulation, blades_of_every_stride_swing_alike) {
  std::vector<vec4> tips[3];
  for (int i = 0; i < 3; ++i) {
    GrassInput input = field({40}, {0.2f, 0.3f, 0.5f}, vec3(5.0f, 0.0f, 2.0f));
    input.steps.frame_steps = 4;
    for (shaders::GrassMaster& master : input.masters) master.stride = 1u << i;
    const SimulateKernel kernel(device());
    for (int frame = 0; frame < 60; ++frame) {
      kernel.advance(input, 1);
      input.steps.wind.drift += input.steps.wind.velocity * (4.0f / 120.0f);
    }
    for (std::size_t k = 15; k < input.knots.size(); k += 16) tips[i].push_back(input.knots[k]);
  }
  for (int i = 1; i < 3; ++i) {
    double mean = 0.0;
    for (std::size_t b = 0; b < tips[0].size(); ++b)
      mean +=
          static_cast<double>(glm::length(vec3(tips[i][b]) - vec3(tips[0][b]))) / static_cast<double>(tips[0].size());
    std::printf("stride %d: tips %.2f mm from those of stride 1\n", 1 << i, 1e3 * mean);
    EXPECT_LT(mean, 0.005);
  }
}

// Hard case: grass.blades_0, grass.not_64, grass.repeatable
TEST_F(GrassSimulation, any_number_of_masters_and_any_size_of_workgroups_gives_the_same_knots) {
  for (const std::uint32_t count : {0u, 1u, 3u, 4u, 5u, 63u, 64u, 65u, 200u}) {
    SCOPED_TRACE(count);
    GrassInput input = field({count}, {0.1f, 0.6f}, vec3(3.0f, 0.0f, 1.0f));
    input.steps.frame_steps = 3;
    SimulateTwin twin(input);
    const GrassOutput first = SimulateKernel(device(), 64).run(input);
    twin.advance(input.steps);
    if (count > 0) expect_sound(twin, first.knots);
    EXPECT_EQ(SimulateKernel(device(), 64).run(input), first) << "again";
    for (const std::uint32_t threads : {32u, 128u, 1u}) {
      SCOPED_TRACE(threads);
      const GrassOutput found = SimulateKernel(device(), threads).run(input);
      if (rounds_alike(device())) {
        EXPECT_EQ(found, first);
      } else {
        EXPECT_LT(twin.distance(found.knots), kBound_m);
      }
    }
  }
}

TEST_F(GrassSimulation, a_blade_does_not_depend_on_the_blades_beside_it) {
  GrassInput input = field({30, 20}, {0.1f, 0.4f}, vec3(3.0f, 0.0f, 1.0f));
  input.steps.frame_steps = 4;
  const GrassOutput all = SimulateKernel(device()).run(input);
  std::reverse(input.masters.begin(), input.masters.end());
  EXPECT_EQ(SimulateKernel(device()).run(input), all) << "the order of the list";
  input.masters.erase(input.masters.begin(), input.masters.begin() + 17);
  input.masters.push_back({0, GLOAM_GRASS_NO_STEP});  // beyond the count
  input.master_count = 33;
  const GrassOutput some = SimulateKernel(device()).run(input);
  for (std::size_t i = 0; i < all.knots.size(); ++i)
    EXPECT_EQ(some.knots[i], i < std::size_t{33} * 16 ? all.knots[i] : vec4(kNowhere)) << i;
}

TEST_F(GrassSimulation, masters_do_as_many_steps_as_the_list_says) {
  GrassInput input = field({40}, {0.1f}, vec3(8.0f, 0.0f, 0.0f));
  const SimulateKernel kernel(device());
  SimulateTwin twin(input);
  input.steps.frame_steps = 2;
  twin.advance(input.steps);
  kernel.advance(input, 1);
  const GrassOutput before{input.knots, input.previous};
  input.steps.frame_steps = 5;
  for (std::uint32_t i = 0; i < 40; ++i) input.masters[i].steps = i % 7;
  GrassInput alike = input;
  const GrassOutput mixed = kernel.run(input);
  for (std::uint32_t steps = 0; steps < 7; ++steps) {
    for (shaders::GrassMaster& m : alike.masters) m.steps = steps;
    const GrassOutput same = kernel.run(alike);
    if (steps == 0) {
      EXPECT_EQ(same, before) << "no step changes nothing";
    }
    for (std::uint32_t i = steps; i < 40; i += 7)
      for (std::uint32_t k = 0; k < kGrassKnots; ++k) {
        EXPECT_EQ(mixed.knots[i * kGrassKnots + k], same.knots[i * kGrassKnots + k]);
        EXPECT_EQ(mixed.previous[i * kGrassKnots + k], same.previous[i * kGrassKnots + k]);
      }
  }
}

TEST_F(GrassSimulation, a_frame_without_steps_puts_new_masters_at_rest) {
  GrassInput input = field({20}, {0.1f}, vec3(8.0f, 0.0f, 0.0f));
  input.steps.frame_steps = 0;
  const SimulateTwin twin(input);
  GrassOutput output = SimulateKernel(device()).run(input);
  EXPECT_LT(twin.distance(output.knots), 1e-6);
  EXPECT_EQ(output.knots, output.previous);
  input.knots = input.previous = output.knots;
  for (shaders::GrassMaster& m : input.masters) m.steps = 3;
  EXPECT_EQ(SimulateKernel(device()).run(input), output);
}

TEST_F(GrassSimulation, holds_in_the_self_test) { expect_holds(grass_kernel_checks()); }

}  // namespace
}  // namespace gloam::test
