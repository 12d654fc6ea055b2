// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "modules/grass/reference/blade_solver.h"
#include "modules/grass/reference/simulation_run.h"

namespace gloam::test {

struct KnotFaults {
  double longest = 0.0;    ///< greatest |length − length at rest|, over the length at rest
  double deepest_m = 0.0;  ///< below the root plane
  double root_m = 0.0;     ///< of a root from its place
  bool finite = true;

  /// at: knots of the blade relative to its root.
  void add(const BladeModel& blade, const std::array<dvec3, kGrassKnots>& at) {
    root_m = std::max(root_m, glm::length(at[0]));
    for (std::size_t k = 0; k < kGrassKnots; ++k) {
      finite = finite && std::isfinite(glm::dot(at[k], at[k]));
      deepest_m = std::max(deepest_m, -glm::dot(at[k], blade.normal));
      if (k == 0) continue;
      const double wanted = glm::length(blade.rest[k] - blade.rest[k - 1]);
      const double off = std::abs(glm::length(at[k] - at[k - 1]) - wanted);
      longest = std::max(longest, wanted > 1e-6 ? off / wanted : off * 1e3);
    }
  }
};

}  // namespace gloam::test
