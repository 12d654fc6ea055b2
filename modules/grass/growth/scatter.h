// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/jobs/executor.h"
#include "modules/grass/growth/surface.h"

namespace gloam {

/// Root of a blade on a growth surface.
struct ScatteredRoot {
  std::uint32_t triangle = 0;  ///< of GrowthSurface::triangles
  double weight1 = 0.0;        ///< barycentric weight of corner 1, ≥ 0
  double weight2 = 0.0;        ///< of corner 2, ≥ 0; weight1 + weight2 ≤ 1
};

/// Position relative to GrowthSurface::origin.
[[nodiscard]] dvec3 root_position(const GrowthSurface& surface, const ScatteredRoot& root);

/// Exactly `count` roots, evenly by area and with blue-noise-like distances. None if the surface has no area. The
/// result depends on the surface's triangles, count and seed only.
[[nodiscard]] std::vector<ScatteredRoot> scatter_roots(const GrowthSurface& surface, std::uint32_t count,
                                                       std::uint32_t seed, JobExecutor& jobs);

}  // namespace gloam
