// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// How far the tips of blades are from where a finer simulation brings them: the error of grass.masters and
// grass.iterations, in millimetres. Both sides are computed in double precision on the CPU, with the twins of the
// kernels (tests hold the kernels against them), from rest and over the same time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/ecs/world.h"
#include "engine/jobs/executor.h"
#include "engine/render/reference/reference.h"
#include "modules/grass/field/grow.h"
#include "modules/grass/reference/blade_solver.h"
#include "modules/grass/simulation/colliders.h"

namespace gloam {

/// The finer simulation: each blade by itself, with this many iterations in steps an eighth as long.
inline constexpr std::uint32_t kTrueIterations = 64;
inline constexpr std::uint32_t kTrueStepParts = 8;

/// What moves the blades.
struct TipConditions {
  const Wind* wind = nullptr;                 ///< null: still air
  std::uint32_t first_step = 0;               ///< number of the step (kGrassStep) at which the blades are at rest
  std::uint32_t steps = 120;                  ///< of kGrassStep
  dvec3 wind_origin = dvec3(0.0);             ///< where the wind's field begins, metres
  std::span<const PlacedCollider> colliders;  ///< they stay where they are
  std::uint32_t most_blades = 512;            ///< blades that are compared, spread evenly over the patches
};

/// Distance in metres of each compared blade's tip. patches: indices of patches of the field. Ground that has turned
/// since it was planted counts as not turned.
[[nodiscard]] std::vector<double> tip_distances(const GrassField& field, std::span<const std::uint32_t> patches,
                                                const TipConditions& conditions, std::uint32_t iterations,
                                                JobExecutor& executor);

/// tip_distances() of the patches in the input's view over a second, with its knobs; in mm. Compares twice as many
/// blades as the input has samples, from 64 to 512. None if the view shows no grass.
[[nodiscard]] Result<std::optional<MovedDistance>> measure_tips(const ReferenceInput& input);

/// measure_tips() for the knobs of the simulation; their pictures are judged by Knob::exact.
[[nodiscard]] std::vector<ReferenceInfo> tip_references();

}  // namespace gloam
