// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/region_quads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "modules/reflections/fitting/surface_grid.h"

namespace gloam {
namespace {

/// Axes in a region's plane; u × v = normal.
struct PlaneAxes {
  dvec3 u = dvec3(1.0, 0.0, 0.0);
  dvec3 v = dvec3(0.0, 1.0, 0.0);
};

PlaneAxes turned(const PlaneAxes& axes, double angle) {
  return {.u = axes.u * std::cos(angle) + axes.v * std::sin(angle),
          .v = axes.v * std::cos(angle) - axes.u * std::sin(angle)};
}

double bounds_area(const WeldedFaces& faces, std::span<const std::uint32_t> members, const PlaneAxes& axes) {
  PlaneBox box;
  for (const std::uint32_t face : members)
    for (std::size_t i = 0; i < 3; ++i)
      box.grow({glm::dot(axes.u, faces.corner(face, i)), glm::dot(axes.v, faces.corner(face, i))});
  return (box.max.x - box.min.x) * (box.max.y - box.min.y);
}

/// Steep planes get a horizontal u. Nearly horizontal planes get the axes of the smallest bounds, in steps of 5°.
PlaneAxes axes_of(const WeldedFaces& faces, const PlanarRegion& region) {
  constexpr double kSteep = 0.95;
  constexpr double kStep = 3.14159265358979323846 / 36.0;
  const dvec3 up = std::abs(region.normal.y) < kSteep ? dvec3(0.0, 1.0, 0.0) : dvec3(0.0, 0.0, -1.0);
  PlaneAxes axes;
  axes.u = glm::normalize(glm::cross(up, region.normal));
  axes.v = glm::cross(region.normal, axes.u);
  if (std::abs(region.normal.y) < kSteep) return axes;
  PlaneAxes best = axes;
  double least = bounds_area(faces, region.faces, axes);
  for (int step = 1; step < 18; ++step) {
    const PlaneAxes candidate = turned(axes, step * kStep);
    // A turn must pay: rounding must not turn a rectangle that has no better axes.
    if (const double area = bounds_area(faces, region.faces, candidate); area < 0.98 * least) {
      least = area;
      best = candidate;
    }
  }
  return best;
}

/// A face in the plane of its region, with its box.
struct PlacedFace {
  PlaneTriangle triangle;
  PlaneBox box;
};

std::vector<PlacedFace> place_faces(const WeldedFaces& faces, const PlanarRegion& region, const PlaneAxes& axes) {
  std::vector<PlacedFace> placed;
  for (const std::uint32_t face : region.faces) {
    PlacedFace item;
    for (std::size_t i = 0; i < 3; ++i) {
      const dvec3& p = faces.corner(face, i);
      item.triangle[i] = {glm::dot(axes.u, p), glm::dot(axes.v, p), glm::dot(region.normal, p) - region.offset_m};
      item.box.grow({item.triangle[i].x, item.triangle[i].y});
    }
    placed.push_back(item);
  }
  std::ranges::stable_sort(placed, [](const PlacedFace& a, const PlacedFace& b) { return a.box.min.x < b.box.min.x; });
  return placed;
}

/// Divides faces, sorted by their left edges, into runs whose boxes are separated by more than the gap along u: one
/// grid around houses that are far apart would have large cells. divide_surface() finds the other gaps.
std::vector<std::span<const PlacedFace>> separate_runs(std::span<const PlacedFace> placed, double gap_m) {
  std::vector<std::span<const PlacedFace>> runs;
  std::size_t first = 0;
  double right = 0.0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (i > first && placed[i].box.min.x > right + gap_m) {
      runs.push_back(placed.subspan(first, i - first));
      first = i;
    }
    right = i == first ? placed[i].box.max.x : std::max(right, placed[i].box.max.x);
  }
  if (first < placed.size()) runs.push_back(placed.subspan(first));
  return runs;
}

void append_quads(const PlanarRegion& region, const PlaneAxes& axes, bool both, std::span<const PlacedFace> run,
                  const QuadSettings& settings, std::vector<FittedQuad>& quads) {
  PlaneBox box;
  for (const PlacedFace& face : run) {
    box.grow(face.box.min);
    box.grow(face.box.max);
  }
  if (box.max.x - box.min.x < settings.min_side_m || box.max.y - box.min.y < settings.min_side_m) return;
  SurfaceGrid grid(box, settings.cell_m);
  for (const PlacedFace& face : run) grid.add(face.triangle);
  for (const SurfaceRectangle& rectangle : divide_surface(grid, settings)) {
    const PlaneBox& b = rectangle.box;
    FittedQuad fitted;
    fitted.covered_m2 = rectangle.covered_m2;
    fitted.quad.normal = region.normal;
    fitted.quad.center = axes.u * (0.5 * (b.min.x + b.max.x)) + axes.v * (0.5 * (b.min.y + b.max.y)) +
                         region.normal * (region.offset_m + rectangle.depth_m);
    fitted.quad.half_u = axes.u * (0.5 * (b.max.x - b.min.x));
    fitted.quad.half_v = axes.v * (0.5 * (b.max.y - b.min.y));
    quads.push_back(fitted);
    if (!both) continue;
    fitted.quad.normal = -fitted.quad.normal;
    fitted.quad.half_u = -fitted.quad.half_u;
    quads.push_back(fitted);
  }
}

std::vector<FittedQuad> quads_of_region(const WeldedFaces& faces, const PlanarRegion& region,
                                        const QuadSettings& settings) {
  std::vector<FittedQuad> quads;
  const bool both =
      std::ranges::any_of(region.faces, [&](std::uint32_t face) { return faces.double_sided[face] != 0; });
  const double up = both ? -std::abs(region.normal.y) : region.normal.y;
  if (region.area_m2 < settings.min_area_m2 * settings.min_coverage || up > settings.max_normal_y) return quads;
  const PlaneAxes axes = axes_of(faces, region);
  const std::vector<PlacedFace> placed = place_faces(faces, region, axes);
  for (const std::span<const PlacedFace> run : separate_runs(placed, settings.gap_m))
    append_quads(region, axes, both, run, settings, quads);
  std::erase_if(quads, [&](const FittedQuad& fitted) { return fitted.quad.normal.y > settings.max_normal_y; });
  return quads;
}

/// Quads without those that differ from an earlier one by less than a few centimetres.
class DistinctQuads {
 public:
  void add(const FittedQuad& fitted) {
    const double key = glm::dot(fitted.quad.center, kDirection);
    const double reach = kNear_m * glm::length(kDirection);
    for (auto near = by_key_.lower_bound(key - reach); near != by_key_.end() && near->first <= key + reach; ++near)
      if (nearly_equal(quads[near->second].quad, fitted.quad)) return;
    by_key_.emplace(key, quads.size());
    quads.push_back(fitted);
  }

  std::vector<FittedQuad> quads;

 private:
  static constexpr double kNear_m = 0.03;
  /// Few centres have the same dot product with it, also in a scene of axis-aligned walls.
  static inline const dvec3 kDirection = dvec3(1.0, 2.3719, 5.1347);

  static bool nearly_equal(const PlacedProxy& a, const PlacedProxy& b) {
    if (glm::dot(a.normal, b.normal) < 0.0) return false;
    const auto corners_a = a.corners();
    const auto corners_b = b.corners();
    for (std::size_t i = 0; i < corners_a.size(); ++i)
      if (glm::length(corners_a[i] - corners_b[i]) > kNear_m) return false;
    return true;
  }

  std::multimap<double, std::size_t> by_key_;
};

void sort_by_area(std::vector<FittedQuad>& quads) {
  std::ranges::stable_sort(quads, [](const FittedQuad& a, const FittedQuad& b) { return a.covered_m2 > b.covered_m2; });
}

}  // namespace

double FittedQuad::coverage() const {
  const double area = 4.0 * glm::length(glm::cross(quad.half_u, quad.half_v));
  return area > 0.0 ? covered_m2 / area : 0.0;
}

std::vector<FittedQuad> fit_quads(const WeldedFaces& faces, std::span<const PlanarRegion> regions,
                                  const QuadSettings& settings, JobExecutor& jobs) {
  constexpr std::size_t kGrain = 16;
  std::vector<std::vector<FittedQuad>> parts((regions.size() + kGrain - 1) / kGrain);
  jobs.parallel_for(regions.size(), kGrain, [&](JobRange range) {
    for (std::size_t i = range.begin; i < range.end; ++i) {
      std::vector<FittedQuad> quads = quads_of_region(faces, regions[i], settings);
      parts[range.ordinal].insert(parts[range.ordinal].end(), quads.begin(), quads.end());
    }
  });
  std::vector<FittedQuad> all;
  for (const std::vector<FittedQuad>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::vector<FittedQuad> fit_quads(std::span<const FitTriangles> instances, const RegionTolerance& tolerance,
                                  const QuadSettings& settings, JobExecutor& jobs) {
  const WeldedFaces faces = weld_faces(instances, kWeld_m);
  const std::vector<PlanarRegion> grown = grow_planar_regions(faces, tolerance);
  std::vector<FittedQuad> quads = fit_quads(faces, join_coplanar(faces, grown, tolerance), settings, jobs);
  sort_by_area(quads);
  return quads;
}

std::vector<FittedQuad> candidate_quads(std::span<const FitTriangles> instances, const QuadSettings& settings,
                                        JobExecutor& jobs) {
  const WeldedFaces faces = weld_faces(instances, kWeld_m);
  QuadSettings overlapping = settings;
  overlapping.with_divided = true;
  constexpr std::array kDistances_m{0.03, 0.08, 0.15, 0.25};
  std::array<std::vector<FittedQuad>, kDistances_m.size()> fitted;
  jobs.parallel_for(fitted.size(), 1, [&](JobRange range) {
    const RegionTolerance tolerance = {.cos_angle = RegionTolerance().cos_angle,
                                       .distance_m = kDistances_m[range.ordinal]};
    const std::vector<PlanarRegion> grown = grow_planar_regions(faces, tolerance);
    fitted[range.ordinal] = fit_quads(faces, join_coplanar(faces, grown, tolerance), overlapping, jobs);
  });
  DistinctQuads candidates;
  for (const std::vector<FittedQuad>& quads : fitted)
    for (const FittedQuad& quad : quads) candidates.add(quad);
  sort_by_area(candidates.quads);
  if (candidates.quads.size() > kMostCandidates) candidates.quads.resize(kMostCandidates);
  return std::move(candidates.quads);
}

}  // namespace gloam
