// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// The kernel of the simulation run alone, and its twin in double precision on the same input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/result.h"
#include "engine/render/kernel_check/kernel_lab.h"
#include "modules/grass/knobs.h"
#include "modules/grass/reference/blade_solver.h"
#include "shaders/grass/grass_shared.h"

namespace gloam {

/// Everything that the kernel reads. Knots of all places; they begin as kNowhere, which the kernel must replace.
struct GrassInput {
  shaders::GrassSteps steps{.step_s = 1.0f / 120.0f, .now = 1, .frame_steps = 1, .iterations = 3};
  std::vector<shaders::GrassPatchRow> patches;
  std::vector<shaders::GrassBladeRow> blades;
  std::vector<shaders::GrassTypeRow> types;
  std::vector<shaders::GrassMaster> masters;
  std::uint32_t master_count = 0;
  std::vector<shaders::GrassCollider> colliders;
  std::vector<vec4> knots;
  std::vector<vec4> previous;
};

struct GrassOutput {
  std::vector<vec4> knots;
  std::vector<vec4> previous;

  bool operator==(const GrassOutput&) const = default;
};

inline constexpr float kNowhere = 1e20f;

/// A type whose stem leans forward as a parabola.
[[nodiscard]] shaders::GrassTypeRow leaning_type(float stiffness);
/// Adds a patch of 4 m with `count` masters at random, which all start at rest, on slopes up to `slope`. The types must
/// be there.
void add_patch(GrassInput& input, std::uint32_t count, std::uint32_t seed, float slope = 0.3f, float length_m = 0.3f);
/// Adds a collider to the first patch, which must be the last one that has colliders.
void add_collider(GrassInput& input, const shaders::GrassCollider& collider);

/// Runs the kernel once. threads: not `device`.
[[nodiscard]] Result<GrassOutput> run_simulation(const KernelLab& lab, const GrassInput& input,
                                                 SimulationThreads threads);
/// The input keeps the knots, all masters go on from them, and the frame's steps have passed.
void take_over(GrassInput& input, GrassOutput output);

/// The twin's state of all masters of an input, which must outlive it.
class SimulateTwin {
 public:
  explicit SimulateTwin(const GrassInput& input);
  void advance(const shaders::GrassSteps& steps);
  /// Greatest distance of a knot from the kernel's, metres; infinite if one is not finite.
  [[nodiscard]] double distance(const std::vector<vec4>& knots) const;
  [[nodiscard]] std::size_t knot_index(std::size_t master, std::size_t k) const;

  std::vector<BladeModel> models;
  std::vector<BladeState> states;

 private:
  const GrassInput& input_;
};

}  // namespace gloam
