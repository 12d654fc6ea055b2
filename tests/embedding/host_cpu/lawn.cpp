// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Grows blades of grass on a slope of two triangles and groups them into patches.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "checks.h"
#include "engine/math/types.h"
#include "modules/grass/components.h"
#include "modules/grass/growth/blade_types.h"
#include "modules/grass/growth/patches.h"
#include "modules/grass/growth/scatter.h"
#include "modules/grass/growth/surface.h"

namespace host {
namespace {

using namespace gloam;

constexpr double kSide_m = 4.0;
constexpr double kRise = 0.25;  // metres of height per metre of z
constexpr std::uint32_t kBlades = 2000;

/// The square 0…4 m in x and z.
GrowthSurface slope() {
  const auto corner = [](double x, double z) { return dvec3(x, kRise * z, z); };
  const dvec3 at[4] = {corner(0.0, 0.0), corner(0.0, kSide_m), corner(kSide_m, kSide_m), corner(kSide_m, 0.0)};
  const vec3 normal(glm::normalize(dvec3(0.0, 1.0, -kRise)));
  GrowthSurface surface;
  surface.origin = dvec3(100.0, 2.0, -50.0);
  const double area = 0.5 * kSide_m * kSide_m * std::sqrt(1.0 + kRise * kRise);
  surface.triangles = {{{at[0], at[1], at[2]}, normal, area, {kNoTriangle, kNoTriangle, 1}, {0, 0, 0}},
                       {{at[0], at[2], at[3]}, normal, area, {0, kNoTriangle, kNoTriangle}, {2, 0, 0}}};
  surface.area_m2 = 2.0 * area;
  return surface;
}

/// Distance of the closest pair of points.
double least_distance(const std::vector<dvec3>& points) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t a = 0; a < points.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) least = std::min(least, glm::distance(points[a], points[b]));
  return least;
}

}  // namespace

void check_lawn(JobExecutor& executor) {
  const GrowthSurface surface = slope();
  const std::vector<ScatteredRoot> roots = scatter_roots(surface, kBlades, 5, executor);
  expect(roots.size() == kBlades, "as many roots are scattered as asked for");
  std::vector<dvec3> points;
  for (const ScatteredRoot& root : roots) points.push_back(root_position(surface, root));
  const bool on_slope = std::ranges::all_of(points, [](const dvec3& p) {
    return std::abs(p.y - kRise * p.z) < 1e-9 && std::min(p.x, p.z) > -1e-9 && std::max(p.x, p.z) < kSide_m + 1e-9;
  });
  expect(on_slope, "every root is on the slope");
  // Of uniformly random roots, some pairs would be a hundred times closer.
  const double grid = std::sqrt(surface.area_m2 / kBlades);
  expect(least_distance(points) > 0.3 * grid, "no two roots are closer than 0.3 of a regular grid's distance");

  const std::vector<BladeType> types = builtin_blade_types();
  std::vector<GrassPatch> patches;
  std::vector<GrassBlade> blades;
  append_patches(surface, roots, {.entity = Entity{1, 1}, .values = {}, .types = types}, executor, patches, blades);
  std::vector<dvec3> grown;
  bool all_small = true;
  for (const GrassPatch& patch : patches) {
    all_small = all_small && patch.blades <= 256;
    for (std::uint32_t i = 0; i < patch.blades; ++i)
      grown.push_back(patch.origin + dvec3(blades[256u * patch.index + i].root_m) - surface.origin);
  }
  expect(all_small && patches.size() >= kBlades / 256, "a patch has at most 256 blades");
  expect(blades.size() == 256 * patches.size(), "a patch has 256 slots");
  const auto before = [](const dvec3& a, const dvec3& b) { return a.x < b.x; };
  std::ranges::sort(grown, before);
  std::ranges::sort(points, before);
  bool same = grown.size() == points.size();
  for (std::size_t i = 0; same && i < points.size(); ++i) same = glm::distance(grown[i], points[i]) < 1e-4;
  expect(same, "the patches hold every root once");
  std::printf("lawn: %zu blades in %zu patches\n", grown.size(), patches.size());
}

}  // namespace host
