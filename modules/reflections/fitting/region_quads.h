// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/jobs/executor.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/fitting/planar_regions.h"

namespace gloam {

struct QuadSettings {
  double max_side_m = 10.0;    ///< larger rectangles are divided
  double min_side_m = 0.5;     ///< smaller rectangles are left out
  double min_area_m2 = 1.0;    ///< rectangles that hold less surface are left out
  double min_coverage = 0.5;   ///< rectangles with a smaller share of surface are divided
  double gap_m = 0.3;          ///< pieces of a plane that are farther apart are fitted separately
  double cell_m = 0.125;       ///< step of the grid in which surface is counted
  double max_normal_y = 0.85;  ///< planes that face up more than this are seen by no reflection at an up normal
  /// Rectangles that are divided are returned too, if they are not too large and hold half of min_coverage: for
  /// callers that choose among overlapping quads.
  bool with_divided = false;
};

/// A rectangle around surface near one plane.
struct FittedQuad {
  PlacedProxy quad;         ///< faces the front of the surface. entity: none
  double covered_m2 = 0.0;  ///< area of the rectangle with surface
  [[nodiscard]] double coverage() const;
};

/// Fits rectangles to each region: in its plane, with a horizontal side where the plane is steep, at the mean distance
/// of its foremost surface. Quads of double-sided regions come twice, facing both ways. In the order of the regions,
/// with every executor.
[[nodiscard]] std::vector<FittedQuad> fit_quads(const WeldedFaces& faces, std::span<const PlanarRegion> regions,
                                                const QuadSettings& settings, JobExecutor& jobs);

/// Welds, grows, joins and fits: one tolerance, no overlapping quads, in descending order of covered area.
[[nodiscard]] std::vector<FittedQuad> fit_quads(std::span<const FitTriangles> instances,
                                                const RegionTolerance& tolerance, const QuadSettings& settings,
                                                JobExecutor& jobs);

/// Most candidates that are returned: those with the largest covered areas.
inline constexpr std::size_t kMostCandidates = 8192;

/// Overlapping quads for choose_quads(): those of several tolerances, between 3 cm and 0.25 m, and those that were
/// divided. In descending order of covered area.
[[nodiscard]] std::vector<FittedQuad> candidate_quads(std::span<const FitTriangles> instances,
                                                      const QuadSettings& settings, JobExecutor& jobs);

}  // namespace gloam
