// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Error of the simulation of grass: the distance between the tips of blades as they are drawn and as a reference in
// double simulates them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "modules/accuracy/metrics/statistics.h"
#include "modules/grass/field/grow.h"
#include "modules/grass/reference/blade_solver.h"
#include "sandbox/bench/grass/probe.h"

namespace gloam {

/// One live blade of a frame.
struct DrawnTip {
  BladeModel model;            ///< of its row, so that packing does not count as error
  dvec3 wind_at = dvec3(0.0);  ///< BladeSteps::wind_at of its patch
  dvec3 tip = dvec3(0.0);      ///< last knot as drawn, relative to its root
  bool master = false;
};

enum class TipChoice { all, masters };

/// The tips of at most `most` live blades, evenly chosen among all of them or among the masters.
[[nodiscard]] std::vector<DrawnTip> drawn_tips(const GrassField& field, const GrassReading& reading, TipChoice choice,
                                               std::size_t most);

/// How the reference simulates.
struct TipSimulation {
  std::uint32_t iterations = 3;
  std::uint32_t step_parts = 1;  ///< steps of the reference in one of the frames' steps
};

/// The last knots of the same blades, relative to their roots, after `frames`, each simulated for itself from rest,
/// without colliders.
[[nodiscard]] std::vector<dvec3> simulated_tips(std::span<const DrawnTip> blades,
                                                std::span<const shaders::GrassSteps> frames, TipSimulation simulation,
                                                JobExecutor& jobs);

/// The tips as drawn, and at rest, relative to the blades' roots.
[[nodiscard]] std::vector<dvec3> tips_of(std::span<const DrawnTip> blades);
[[nodiscard]] std::vector<dvec3> rest_tips(std::span<const DrawnTip> blades);

/// Distances between the tips of the same blades, millimetres. As many of both.
[[nodiscard]] ErrorStatistics tip_error_mm(std::span<const dvec3> reference, std::span<const dvec3> tips);

/// Hash of the drawn tips, to the bit.
[[nodiscard]] std::uint64_t hash_of_tips(std::span<const DrawnTip> drawn);

}  // namespace gloam
