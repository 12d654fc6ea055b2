// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "modules/grass/reference/blade_solver.h"

namespace gloam {

/// How all knots of a slave follow from those of its master: k ↦ turn · k, relative to the roots.
struct SlaveTurn {
  dvec3 axes[3];  ///< columns of the rotation and scale
};

/// The parts of a blade that the pose of a slave depends on.
struct SlaveStem {
  dvec3 normal = dvec3(0.0, 1.0, 0.0);
  double yaw = 0.0;
  double length_m = 0.3;
};

/// CPU twin of slave_turn() in shaders/grass/simulation/slave_api.glsl, which describes it. slot: index of the slave in
/// its patch. master_tip, rest_tip: the master's last knot, now and at rest, relative to its root. tip_speed: m/s.
[[nodiscard]] SlaveTurn slave_turn(const SlaveStem& master, const SlaveStem& slave, std::uint32_t slot,
                                   dvec3 master_tip, dvec3 rest_tip, double tip_speed);

/// A knot of the slave, relative to its root. master_knot: relative to the master's root.
[[nodiscard]] dvec3 slave_knot(const SlaveTurn& turn, dvec3 master_knot);

}  // namespace gloam
