// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "modules/grass/growth/random.h"
#include "modules/grass/growth/scatter.h"
#include "modules/grass/growth/surface.h"

namespace gloam {

/// A path through a surface on which equal lengths cover equal areas: triangle by triangle along a Hilbert curve, and
/// within a triangle by halving its longest edge again and again. Nearby numbers are nearby places, so one random root
/// in each of `count` equal parts of the path is a stratified sample of the area.
class AreaCurve {
 public:
  explicit AreaCurve(const GrowthSurface& surface);

  /// A random root in part `index` of `count` equal parts. The surface must have an area.
  [[nodiscard]] ScatteredRoot root(std::uint32_t index, std::uint32_t count, BladeRandom random) const;

 private:
  const GrowthSurface& surface_;
  std::vector<std::uint32_t> order_;  ///< triangles along the Hilbert curve
  std::vector<double> ends_;          ///< area up to the end of each, in that order
};

}  // namespace gloam
