// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "engine/jobs/executor.h"
#include "modules/grass/components.h"
#include "modules/grass/simulation/wind.h"
#include "shaders/grass/grass_shared.h"

// The simulation of blades in double, as docs/architecture.md, "Grass simulation", specifies it, for any step length
// and any number of iterations. Positions are relative to the patch's origin.

namespace gloam {

inline constexpr std::size_t kGrassKnots = GLOAM_GRASS_KNOTS;

/// One blade: everything that its motion depends on, apart from wind and colliders.
struct BladeModel {
  dvec3 root = dvec3(0.0);
  dvec3 normal = dvec3(0.0, 1.0, 0.0);
  dvec3 forward = dvec3(1.0, 0.0, 0.0);  ///< direction in which the stem leans
  double length_m = 0.3;
  double width_m = 0.006;  ///< at the root
  double stiffness = 0.5;
  double damping = 1.5;                   ///< 1/s: a swing falls to 1/e in 1 s over damping
  std::array<dvec3, kGrassKnots> rest{};  ///< relative to the root
};

struct BladeState {
  std::array<dvec3, kGrassKnots> at{};      ///< relative to the root
  std::array<dvec3, kGrassKnots> before{};  ///< a step earlier
};

/// Parameters of a frame that all blades of a patch share.
struct BladeSteps {
  WindField wind;              ///< at the begin of the frame
  dvec3 wind_at = dvec3(0.0);  ///< position of the patch's origin in the wind's field
  double step_s = 1.0 / 120.0;
  std::uint32_t frame_steps = 1;
  std::uint32_t iterations = 3;         ///< ≥ 1
  dvec3 pull = dvec3(0.0, -9.81, 0.0);  ///< external acceleration, along the patch's axes
  std::span<const shaders::GrassCollider> colliders;
};

/// v, turned by the least rotation that takes unit vector a to unit vector b. If they are opposite, v is mirrored.
[[nodiscard]] dvec3 turned(dvec3 a, dvec3 b, dvec3 v);

/// Direction in which a blade leans: +X turned by the least rotation from +Y to the normal, then by yaw about it.
[[nodiscard]] dvec3 blade_forward(dvec3 normal, double yaw);

/// The blade that a row describes, and that a component describes.
[[nodiscard]] BladeModel blade_model(const shaders::GrassPatchRow& patch, const shaders::GrassBladeRow& row,
                                     std::span<const shaders::GrassTypeRow> types);
[[nodiscard]] BladeModel blade_model(const GrassBlade& blade, std::span<const shaders::GrassTypeRow> types);

[[nodiscard]] BladeState rest_state(const BladeModel& blade);

/// Runs the frame's last `steps` steps; at most frame_steps.
void advance_blade(const BladeModel& blade, const BladeSteps& frame, std::uint32_t steps, BladeState& state);

/// Runs all steps of the frame for all blades, in parallel. states: as many as blades.
void advance_blades(std::span<const BladeModel> blades, const BladeSteps& frame, JobExecutor& jobs,
                    std::span<BladeState> states);

/// Kinetic and gravity energy, and that of the bent joints, over the mass of a knot: m²/s². Gravity acts by the knots'
/// shares.
[[nodiscard]] double blade_energy(const BladeModel& blade, const BladeState& state, double step_s);

}  // namespace gloam
