// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/diffuse/neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "modules/reflections/bake/picture.h"
#include "modules/reflections/bake/probe_map.h"
#include "modules/reflections/relighting/light_states.h"

namespace gloam {
namespace {

constexpr std::size_t kCells = std::size_t{kProbeCells} * kProbeCells;
constexpr double kFar = 8.0;              // harmonic means
constexpr double kWholeSky = 0.5 * 0.25;  // of the sphere

/// Solid angle of a cell; those of all sum to 1. A cell of the octahedron |x| + |y| + |z| = 1 shows a solid angle as
/// the cube of its closeness.
std::vector<double> cell_shares() {
  std::vector<double> shares(kCells);
  double sum = 0.0;
  for (std::size_t i = 0; i < kCells; ++i) {
    const vec2 cell(static_cast<float>(i % kProbeCells), static_cast<float>(i / kProbeCells));
    const dvec3 d = glm::abs(dvec3(probe_map_direction((cell + 0.5f) / static_cast<float>(kProbeCells))));
    sum += shares[i] = std::pow(d.x + d.y + d.z, 3.0);
  }
  for (double& share : shares) share /= sum;
  return shares;
}

}  // namespace

ProbeNeighbourhood probe_neighbourhood(std::span<const CapturedSurface> surfaces, std::span<const vec3> unlit,
                                       const vec3& sky) {
  ProbeNeighbourhood found{std::numeric_limits<float>::infinity(), 0.0f};
  if (surfaces.size() != kCells || unlit.size() != kCells) return found;
  const std::vector<double> shares = cell_shares();
  const auto is_sky = [&](std::size_t i) { return surfaces[i].normal == vec3(0.0f); };
  const auto closeness = [&](std::size_t i) {
    return is_sky(i) ? 0.0 : 1.0 / std::max(glm::length(dvec3(surfaces[i].position)), 1e-30);
  };
  double mean = 0.0, near = 0.0, near_closeness = 0.0, open = 0.0;
  for (std::size_t i = 0; i < kCells; ++i) mean += shares[i] * closeness(i);
  const double of_sky = luminance_of(dvec3(sky));
  for (std::size_t i = 0; i < kCells; ++i) {
    if (is_sky(i)) {
      open += shares[i];
    } else if (closeness(i) < mean / kFar) {
      const double seen = luminance_of(dvec3(unlit[i]));
      open += shares[i] * (seen < of_sky ? seen / of_sky : 1.0);
    } else {
      near += shares[i];
      near_closeness += shares[i] * closeness(i);
    }
  }
  if (near > 0.0) found.reach = static_cast<float>(near / near_closeness);
  found.open = static_cast<float>(std::min(open / kWholeSky, 1.0));
  return found;
}

}  // namespace gloam
