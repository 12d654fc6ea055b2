// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "engine/jobs/executor.h"
#include "engine/math/packing.h"
#include "modules/grass/reference/blade_solver.h"
#include "shaders/grass/shaders.h"
#include "tests/modules/grass/support/blades.h"
#include "tests/support/kernel.h"

namespace gloam::test {

using KnotRows = std::vector<vec4>;

/// Everything that the kernel reads. Knots of all places; they begin as kNowhere, which the kernel must replace.
struct GrassInput {
  shaders::GrassSteps steps{.step_s = 1.0f / 120.0f, .now = 1, .frame_steps = 1, .iterations = 3};
  std::vector<shaders::GrassPatchRow> patches;
  std::vector<shaders::GrassBladeRow> blades;
  std::vector<shaders::GrassTypeRow> types;
  std::vector<shaders::GrassMaster> masters;
  std::uint32_t master_count = 0;
  std::vector<shaders::GrassCollider> colliders;
  KnotRows knots;
  KnotRows previous;
};

struct GrassOutput {
  KnotRows knots;
  KnotRows previous;

  bool operator==(const GrassOutput&) const = default;
};

inline void PrintTo(const GrassOutput& output, std::ostream* out) {
  std::uint64_t hash = 1469598103934665603u;
  for (const vec4& knot : output.knots)
    for (int i = 0; i < 3; ++i) hash = (hash ^ std::bit_cast<std::uint32_t>(knot[i])) * 1099511628211u;
  *out << output.knots.size() << " knots of hash " << hash;
}

inline constexpr float kNowhere = 1e20f;

[[nodiscard]] inline shaders::GrassBladeRow blade_row(vec3 root_share, vec3 normal, float length_m, std::uint32_t yaw,
                                                      std::uint32_t type) {
  const auto share16 = [](float v) { return static_cast<std::uint32_t>(std::lround(v * 65535.0f)); };
  const auto signed8 = [](float v) { return static_cast<std::uint32_t>(std::lround(v * 127.0f)) & 0xFFu; };
  const vec2 code = octahedral_encode(normal);
  shaders::GrassBladeRow row{};
  row.root_xz = share16(root_share.x) | share16(root_share.z) << 16;
  row.root_y_normal = share16(root_share.y) | signed8(code.x) << 16 | signed8(code.y) << 24;
  row.size = std::uint32_t{float_to_half(length_m)} | std::uint32_t{float_to_half(0.006f)} << 16;
  row.kind = yaw | type << 8;
  return row;
}

/// A patch of 4 m with `count` masters at random, which all start at rest, on slopes up to `slope`.
inline void add_patch(GrassInput& input, std::uint32_t count, std::uint32_t seed, float slope = 0.3f,
                      float length_m = 0.3f) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  const auto patch = static_cast<std::uint32_t>(input.patches.size());
  shaders::GrassPatchRow row{};
  row.box_from = vec3(-2.0f, -0.2f, -2.0f);
  row.box_size = vec3(4.0f, 0.4f, 4.0f);
  row.wind_at = vec3(250.0f * unit(random), 10.0f, 250.0f * unit(random));
  row.first_blade = static_cast<std::uint32_t>(input.blades.size());
  row.blades = count;
  row.first_place = static_cast<std::uint32_t>(input.knots.size() / GLOAM_GRASS_KNOTS);
  row.first_collider = static_cast<std::uint32_t>(input.colliders.size());
  input.patches.push_back(row);
  for (std::uint32_t i = 0; i < count; ++i) {
    const vec3 normal =
        glm::normalize(vec3(slope * (2.0f * unit(random) - 1.0f), 1.0f, slope * (2.0f * unit(random) - 1.0f)));
    const vec3 at(unit(random), unit(random), unit(random));
    input.blades.push_back(blade_row(at, normal, length_m * (0.6f + 0.8f * unit(random)),
                                     static_cast<std::uint32_t>(random() % 256),
                                     static_cast<std::uint32_t>(random() % input.types.size())));
    input.masters.push_back({patch << 8 | i, GLOAM_GRASS_NO_STEP});
  }
  input.master_count = static_cast<std::uint32_t>(input.masters.size());
  input.knots.resize(input.knots.size() + std::size_t{count} * GLOAM_GRASS_KNOTS, vec4(kNowhere));
  input.previous = input.knots;
}

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
    for (std::uint32_t f = 0; f < frames; ++f) {
      GrassOutput output = run(input);
      input.knots = std::move(output.knots);
      input.previous = std::move(output.previous);
      for (shaders::GrassMaster& m : input.masters) m.steps = 1000;
      input.steps.now += input.steps.frame_steps;
    }
  }

 private:
  [[nodiscard]] GrassOutput run_with(const GrassInput& input, std::uint32_t threads) const {
    const gpu::SpecConstant colliders{"kColliders", !input.colliders.empty()};
    const bool of_blades = threads == 1;
    Kernel kernel(device_, of_blades ? shaders::grass::simulate_blades_comp : shaders::grass::simulate_comp,
                  of_blades ? gpu::SpecConstants{colliders} : gpu::SpecConstants{{"local_size_x", threads}, colliders});
    const auto some = [](auto items) {
      if (items.empty()) items.resize(1);
      return items;
    };
    kernel.input(0, std::vector<shaders::GrassSteps>{input.steps});
    kernel.input(1, some(input.patches));
    kernel.input(2, some(input.blades));
    kernel.input(3, some(input.types));
    kernel.input(4, some(input.masters));
    kernel.input(5, std::vector<std::uint32_t>{input.master_count});
    kernel.input(6, some(input.colliders));
    kernel.in_out(7, some(input.knots));
    kernel.in_out(8, some(input.previous));
    const std::uint32_t blades = of_blades ? 64 : threads / GLOAM_GRASS_KNOTS;
    kernel.run(std::max((input.master_count + blades - 1) / blades, 1u));
    return {kernel.read<vec4>(7), kernel.read<vec4>(8)};
  }

  gpu::Device& device_;
  std::uint32_t threads_;
};

/// The twin's state of all masters of an input.
class SimulateTwin {
 public:
  explicit SimulateTwin(const GrassInput& input) : input_(input) {
    for (const shaders::GrassMaster& m : input.masters) {
      const shaders::GrassPatchRow& patch = input.patches[m.blade >> 8];
      models.push_back(blade_model(patch, input.blades[patch.first_blade + (m.blade & 0xFFu)], input.types));
      states.push_back(rest_state(models.back()));
    }
  }
  void advance(const shaders::GrassSteps& steps) {
    for (std::size_t i = 0; i < models.size(); ++i) {
      const shaders::GrassPatchRow& patch = input_.patches[input_.masters[i].blade >> 8];
      BladeSteps frame;
      frame.wind = from_shader(steps.wind);
      frame.wind_at = dvec3(patch.wind_at);
      frame.step_s = static_cast<double>(steps.step_s);
      frame.frame_steps = steps.frame_steps;
      frame.iterations = steps.iterations;
      frame.colliders = std::span(input_.colliders).subspan(patch.first_collider, patch.colliders);
      advance_blade(models[i], frame, steps.frame_steps, states[i]);
    }
  }
  /// Greatest distance of a knot from the kernel's, metres; infinite if one is not finite.
  [[nodiscard]] double distance(const KnotRows& knots) const {
    double most = 0.0;
    for (std::size_t i = 0; i < models.size(); ++i)
      for (std::size_t k = 0; k < kGrassKnots; ++k) {
        const double d = glm::length(models[i].root + states[i].at[k] - dvec3(knots[knot_index(i, k)]));
        most = std::isfinite(d) ? std::max(most, d) : std::numeric_limits<double>::infinity();
      }
    return most;
  }
  /// Share of the masters of which all knots are within this distance of the kernel's.
  [[nodiscard]] double share_within(const KnotRows& knots, double bound_m) const {
    std::size_t within = 0;
    for (std::size_t i = 0; i < models.size(); ++i) {
      bool all = true;
      for (std::size_t k = 0; k < kGrassKnots; ++k)
        all = all && glm::length(models[i].root + states[i].at[k] - dvec3(knots[knot_index(i, k)])) < bound_m;
      within += all ? 1 : 0;
    }
    return static_cast<double>(within) / static_cast<double>(std::max<std::size_t>(models.size(), 1));
  }
  [[nodiscard]] std::size_t knot_index(std::size_t master, std::size_t k) const {
    const std::uint32_t blade = input_.masters[master].blade;
    return (std::size_t{input_.patches[blade >> 8].first_place} + (blade & 0xFFu)) * kGrassKnots + k;
  }

  std::vector<BladeModel> models;
  std::vector<BladeState> states;

 private:
  const GrassInput& input_;
};

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
