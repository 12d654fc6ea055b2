// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/growth/scatter.h"

#include <cstddef>

#include "modules/grass/growth/curve.h"
#include "modules/grass/growth/random.h"
#include "modules/grass/growth/relax.h"

namespace gloam {

dvec3 root_position(const GrowthSurface& surface, const ScatteredRoot& root) {
  const auto& [a, b, c] = surface.triangles[root.triangle].corners;
  return a + (b - a) * root.weight1 + (c - a) * root.weight2;
}

std::vector<ScatteredRoot> scatter_roots(const GrowthSurface& surface, std::uint32_t count, std::uint32_t seed,
                                         JobExecutor& jobs) {
  constexpr std::uint32_t kRootNumbers = 0;
  constexpr int kSteps = 2;
  if (count == 0 || !(surface.area_m2 > 0.0)) return {};
  const AreaCurve curve(surface);
  std::vector<ScatteredRoot> roots(count);
  jobs.parallel_for(count, 4096, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      const auto index = static_cast<std::uint32_t>(i);
      roots[i] = curve.root(index, count, BladeRandom(seed, index, kRootNumbers));
    }
  });
  relax_roots(surface, kSteps, jobs, roots);
  return roots;
}

}  // namespace gloam
