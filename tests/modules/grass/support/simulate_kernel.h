// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <vector>

#include "modules/grass/reference/simulation_run.h"
#include "tests/modules/grass/support/blades.h"
#include "tests/support/kernel.h"

namespace gloam {

inline void PrintTo(const GrassOutput& output, std::ostream* out) {
  std::uint64_t hash = 1469598103934665603u;
  for (const vec4& knot : output.knots)
    for (int i = 0; i < 3; ++i) hash = (hash ^ std::bit_cast<std::uint32_t>(knot[i])) * 1099511628211u;
  *out << output.knots.size() << " knots of hash " << hash;
}

}  // namespace gloam

namespace gloam::test {

using KnotRows = std::vector<vec4>;

/// Whether both kernels give the same bits: where divisions and roots are rounded correctly (lavapipe). Vulkan lets
/// them err by a few roundings, and SwiftShader rounds them differently in the two kernels.
inline bool rounds_alike(gpu::Device& device) { return device.info().driver.find("SwiftShader") == std::string::npos; }

/// Runs the kernel once. threads: of a workgroup with a thread a knot; 1: a thread a blade. With 64, the kernel with a
/// thread a blade runs, too, and must give the same bits; where kernels do not round alike, it runs instead, because
/// the module takes it on devices of the kind cpu. The input's knots continue with the output's.
class SimulateKernel {
 public:
  explicit SimulateKernel(gpu::Device& device, std::uint32_t threads = 64) : device_(device), threads_(threads) {}

  [[nodiscard]] GrassOutput run(const GrassInput& input) const {
    if (threads_ == 64 && !rounds_alike(device_)) return run_with(input, 1);
    const GrassOutput found = run_with(input, threads_);
    if (threads_ == 64) {
      EXPECT_EQ(run_with(input, 1), found) << "a thread a blade";
    }
    return found;
  }

  /// Runs `frames` frames of input.steps.frame_steps steps; the input keeps the knots, and all masters go on from them.
  void advance(GrassInput& input, std::uint32_t frames) const {
    for (std::uint32_t f = 0; f < frames; ++f) take_over(input, run(input));
  }

 private:
  [[nodiscard]] GrassOutput run_with(const GrassInput& input, std::uint32_t threads) const {
    using enum SimulationThreads;
    const SimulationThreads kind = threads == 32    ? knots_32
                                   : threads == 64  ? knots_64
                                   : threads == 128 ? knots_128
                                                    : blade;
    return value_of(run_simulation(KernelLab(device_, gpu_log()), input, kind));
  }

  gpu::Device& device_;
  std::uint32_t threads_;
};

/// Share of the masters of which all knots are within this distance of the kernel's.
[[nodiscard]] inline double share_within(const SimulateTwin& twin, const KnotRows& knots, double bound_m) {
  std::size_t within = 0;
  for (std::size_t i = 0; i < twin.models.size(); ++i) {
    bool all = true;
    for (std::size_t k = 0; k < kGrassKnots; ++k)
      all = all &&
            glm::length(twin.models[i].root + twin.states[i].at[k] - dvec3(knots[twin.knot_index(i, k)])) < bound_m;
    within += all ? 1 : 0;
  }
  return static_cast<double>(within) / static_cast<double>(std::max<std::size_t>(twin.models.size(), 1));
}

[[nodiscard]] inline KnotFaults faults_of(const SimulateTwin& twin, const KnotRows& knots) {
  KnotFaults faults;
  for (std::size_t i = 0; i < twin.models.size(); ++i) {
    std::array<dvec3, kGrassKnots> at;
    for (std::size_t k = 0; k < kGrassKnots; ++k) at[k] = dvec3(knots[twin.knot_index(i, k)]) - twin.models[i].root;
    faults.add(twin.models[i], at);
  }
  return faults;
}

/// Lengths within 1 %, nothing below the ground or not finite, roots in their places.
inline void expect_sound(const SimulateTwin& twin, const KnotRows& knots) {
  const KnotFaults faults = faults_of(twin, knots);
  EXPECT_TRUE(faults.finite);
  EXPECT_LE(faults.longest, 0.01);
  EXPECT_LE(faults.deepest_m, 2e-6);
  EXPECT_LE(faults.root_m, 1e-6);
}

}  // namespace gloam::test
