// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/reference/simulation_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <utility>

#include "engine/math/packing.h"
#include "engine/render/kernel_check/kernel_run.h"
#include "modules/grass/simulation/simulate_blades_pass.h"

namespace gloam {
namespace {

shaders::GrassBladeRow blade_row(vec3 root_share, vec3 normal, float length_m, std::uint32_t yaw, std::uint32_t type) {
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

template <class T>
std::vector<T> at_least_one(std::vector<T> items) {
  if (items.empty()) items.resize(1);
  return items;
}

}  // namespace

shaders::GrassTypeRow leaning_type(float stiffness) {
  shaders::GrassTypeRow type{};
  for (int k = 0; k < GLOAM_GRASS_KNOTS; ++k) {
    const float u = static_cast<float>(k) / (GLOAM_GRASS_KNOTS - 1);
    type.stem[k] = vec2(0.3f * u * u, 0.95f * u);
  }
  type.stiffness = stiffness;
  type.taper = 0.1f;
  type.damping = 1.5f;
  return type;
}

void add_patch(GrassInput& input, std::uint32_t count, std::uint32_t seed, float slope, float length_m) {
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

void add_collider(GrassInput& input, const shaders::GrassCollider& collider) {
  input.colliders.push_back(collider);
  input.patches[0].colliders = static_cast<std::uint32_t>(input.colliders.size());
}

Result<GrassOutput> run_simulation(const KernelLab& lab, const GrassInput& input, SimulationThreads threads) {
  const ComputeProgram program = grass_simulation_program(threads, !input.colliders.empty());
  KernelRun kernel(lab, program.shader, program.constants);
  kernel.input(0, std::vector<shaders::GrassSteps>{input.steps});
  kernel.input(1, at_least_one(input.patches));
  kernel.input(2, at_least_one(input.blades));
  kernel.input(3, at_least_one(input.types));
  kernel.input(4, at_least_one(input.masters));
  kernel.input(5, std::vector<std::uint32_t>{input.master_count});
  kernel.input(6, at_least_one(input.colliders));
  kernel.in_out(7, at_least_one(input.knots));
  kernel.in_out(8, at_least_one(input.previous));
  const std::uint32_t masters = simulation_group_masters(threads);
  GLOAM_TRY(kernel.run(std::max((input.master_count + masters - 1) / masters, 1u)));
  return GrassOutput{kernel.read<vec4>(7), kernel.read<vec4>(8)};
}

void take_over(GrassInput& input, GrassOutput output) {
  input.knots = std::move(output.knots);
  input.previous = std::move(output.previous);
  for (shaders::GrassMaster& m : input.masters) m.steps = 1000;
  input.steps.now += input.steps.frame_steps;
}

SimulateTwin::SimulateTwin(const GrassInput& input) : input_(input) {
  for (const shaders::GrassMaster& m : input.masters) {
    const shaders::GrassPatchRow& patch = input.patches[m.blade >> 8];
    models.push_back(blade_model(patch, input.blades[patch.first_blade + (m.blade & 0xFFu)], input.types));
    states.push_back(rest_state(models.back()));
  }
}

void SimulateTwin::advance(const shaders::GrassSteps& steps) {
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

double SimulateTwin::distance(const std::vector<vec4>& knots) const {
  double most = 0.0;
  for (std::size_t i = 0; i < models.size(); ++i)
    for (std::size_t k = 0; k < kGrassKnots; ++k) {
      const double d = glm::length(models[i].root + states[i].at[k] - dvec3(knots[knot_index(i, k)]));
      most = std::isfinite(d) ? std::max(most, d) : std::numeric_limits<double>::infinity();
    }
  return most;
}

std::size_t SimulateTwin::knot_index(std::size_t master, std::size_t k) const {
  const std::uint32_t blade = input_.masters[master].blade;
  return (std::size_t{input_.patches[blade >> 8].first_place} + (blade & 0xFFu)) * kGrassKnots + k;
}

}  // namespace gloam
