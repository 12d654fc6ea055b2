// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/growth/relax.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gloam {
namespace {

constexpr std::size_t kGrain = 4096;  // roots per job

/// Points by cell of a grid. The cell (x, y, z) is found in bucket x + y·stride_y + z·stride_z modulo the number of
/// buckets: neighbours along x are adjacent in memory, and the 27 cells around a place are 27 different buckets. A
/// bucket may also hold points of far cells.
class PointGrid {
 public:
  PointGrid(std::size_t points, double cell_m)
      : per_m_(1.0 / cell_m),
        mask_(static_cast<std::uint32_t>(std::bit_ceil(std::max<std::size_t>(points, 1024))) - 1) {
    stride_y_ = static_cast<std::uint32_t>(0.7548776662 * mask_) | 1u;
    stride_z_ = static_cast<std::uint32_t>(0.6180339887 * mask_) | 1u;
    starts_.resize(std::size_t{mask_} + 4);
    order_.resize(points);
    buckets_.resize(points);
    sorted_.resize(points);
  }

  void fill(std::span<const dvec3> points, JobExecutor& jobs) {
    jobs.parallel_for(points.size(), kGrain, [&](JobRange range) {
      for (std::size_t i = range.begin; i < range.end; ++i) buckets_[i] = bucket_of(points[i]);
    });
    std::ranges::fill(starts_, 0u);
    for (const std::uint32_t bucket : buckets_) ++starts_[bucket + 1];
    for (std::size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
    std::vector<std::uint32_t> next(starts_.begin(), starts_.end());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      const std::uint32_t place = next[buckets_[i]]++;
      order_[place] = i;
      sorted_[place] = points[i];
    }
  }

  /// Point of each place in the order of buckets.
  [[nodiscard]] std::uint32_t point_at(std::size_t place) const { return order_[place]; }
  [[nodiscard]] const dvec3& position_at(std::size_t place) const { return sorted_[place]; }

  /// Calls use(position) for all points that may be within one cell's size of `at`, the point there included.
  template <class Use>
  void each_near(const dvec3& at, Use&& use) const {
    const std::uint32_t center = bucket_of(at);
    for (std::uint32_t y = 0; y < 3; ++y) {
      for (std::uint32_t z = 0; z < 3; ++z) {
        const std::uint32_t row = (center + (y - 1) * stride_y_ + (z - 1) * stride_z_ - 1) & mask_;
        if (row + 2 <= mask_) {
          for (std::uint32_t p = starts_[row]; p < starts_[row + 3]; ++p) use(sorted_[p]);
          continue;
        }
        for (std::uint32_t x = 0; x < 3; ++x) {
          const std::uint32_t bucket = (row + x) & mask_;
          for (std::uint32_t p = starts_[bucket]; p < starts_[bucket + 1]; ++p) use(sorted_[p]);
        }
      }
    }
  }

 private:
  [[nodiscard]] std::uint32_t cell(double at) const {
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(std::clamp(std::floor(at * per_m_), -9e15, 9e15)));
  }
  [[nodiscard]] std::uint32_t bucket_of(const dvec3& at) const {
    return (cell(at.x) + cell(at.y) * stride_y_ + cell(at.z) * stride_z_) & mask_;
  }

  double per_m_;
  std::uint32_t mask_;
  std::uint32_t stride_y_;
  std::uint32_t stride_z_;
  std::vector<std::uint32_t> starts_;   ///< first place of each bucket
  std::vector<std::uint32_t> order_;    ///< point of each place
  std::vector<std::uint32_t> buckets_;  ///< of each point
  std::vector<dvec3> sorted_;           ///< position of each place
};

/// Walks from a root along a displacement: straight within a triangle, unfolded across edges.
class SurfaceWalk {
 public:
  SurfaceWalk(const GrowthSurface& surface, const ScatteredRoot& root)
      : surface_(surface),
        triangle_(root.triangle),
        weights_{1.0 - root.weight1 - root.weight2, root.weight1, root.weight2} {}

  void walk(dvec3 way) {
    constexpr int kMostEdges = 64;
    for (int i = 0; i < kMostEdges && step(way); ++i) {
    }
  }

  [[nodiscard]] ScatteredRoot root() const {
    ScatteredRoot root{triangle_, std::clamp(weights_[1], 0.0, 1.0), 0.0};
    root.weight2 = std::clamp(weights_[2], 0.0, 1.0 - root.weight1);
    return root;
  }

 private:
  /// Moves within one triangle. Returns whether the walk goes on in a neighbour; `way` is then the rest.
  bool step(dvec3& way) {
    const GrowthTriangle& triangle = surface_.triangles[triangle_];
    const std::array<double, 3> change = weight_changes(triangle, way);
    double share = 1.0;
    std::size_t leaving = 3;  // corner whose weight becomes 0 first
    for (std::size_t i = 0; i < 3; ++i) {
      if (change[i] >= 0.0 || weights_[i] + share * change[i] >= 0.0) continue;
      share = std::max(weights_[i], 0.0) / -change[i];
      leaving = i;
    }
    const std::size_t edge = (leaving + 1) % 3;
    const bool border = leaving < 3 && triangle.neighbors[edge] == kNoTriangle;
    if (border) return false;  // a step to the border would gather roots on it
    for (std::size_t i = 0; i < 3; ++i) weights_[i] += share * change[i];
    if (leaving == 3) return false;
    const std::size_t other = triangle.neighbor_edges[edge];
    const std::array<double, 3> old = weights_;
    weights_[other] = old[(edge + 1) % 3];
    weights_[(other + 1) % 3] = old[edge];
    weights_[(other + 2) % 3] = 0.0;
    triangle_ = triangle.neighbors[edge];
    return unfold(way, 1.0 - share, other);
  }

  /// Turns the rest of the way into the plane of the triangle that was entered across `edge`. False if it does not lead
  /// inward.
  bool unfold(dvec3& way, double remaining_share, std::size_t edge) const {
    const GrowthTriangle& triangle = surface_.triangles[triangle_];
    const dvec3 normal(triangle.normal);
    const dvec3 flat = way - normal * glm::dot(way, normal);
    const double length = glm::length(flat);
    if (!(length > 0.0)) return false;
    way = flat * (remaining_share * glm::length(way) / length);
    return weight_changes(triangle, way)[(edge + 2) % 3] > 0.0;
  }

  static std::array<double, 3> weight_changes(const GrowthTriangle& triangle, const dvec3& way) {
    const dvec3 e1 = triangle.corners[1] - triangle.corners[0];
    const dvec3 e2 = triangle.corners[2] - triangle.corners[0];
    const double g11 = glm::dot(e1, e1);
    const double g12 = glm::dot(e1, e2);
    const double g22 = glm::dot(e2, e2);
    const double determinant = g11 * g22 - g12 * g12;
    if (!(determinant > 0.0)) return {};
    const double a = glm::dot(e1, way);
    const double b = glm::dot(e2, way);
    const double u = (g22 * a - g12 * b) / determinant;
    const double v = (g11 * b - g12 * a) / determinant;
    return {-u - v, u, v};
  }

  const GrowthSurface& surface_;
  std::uint32_t triangle_;
  std::array<double, 3> weights_;
};

/// Displacement of the point at `at`, in the plane of the normal.
dvec3 repulsion(const PointGrid& grid, const dvec3& at, const dvec3& normal, double reach_m) {
  constexpr double kStrength = 0.35;
  dvec3 sum(0.0);
  grid.each_near(at, [&](const dvec3& other) {
    const dvec3 away = at - other;
    const double squared = glm::dot(away, away);
    if (squared >= reach_m * reach_m || !(squared > 0.0)) return;
    const double distance = std::sqrt(squared);
    sum += away * ((reach_m - distance) / distance);
  });
  sum = (sum - normal * glm::dot(sum, normal)) * kStrength;
  const double length = glm::length(sum);
  const double most = 0.5 * reach_m;
  return length > most ? sum * (most / length) : sum;
}

}  // namespace

void relax_roots(const GrowthSurface& surface, int steps, JobExecutor& jobs, std::span<ScatteredRoot> roots) {
  if (roots.size() < 2) return;
  // Distance of neighbours in a triangular lattice of the same density.
  const double reach_m = std::sqrt(2.0 / std::sqrt(3.0) * surface.area_m2 / static_cast<double>(roots.size()));
  if (!(reach_m > 0.0) || !std::isfinite(1.0 / reach_m)) return;
  PointGrid grid(roots.size(), reach_m);
  std::vector<dvec3> positions(roots.size());
  for (int i = 0; i < steps; ++i) {
    jobs.parallel_for(roots.size(), kGrain, [&](JobRange range) {
      for (std::size_t r = range.begin; r < range.end; ++r) positions[r] = root_position(surface, roots[r]);
    });
    grid.fill(positions, jobs);
    jobs.parallel_for(roots.size(), kGrain, [&](JobRange range) {
      for (std::size_t place = range.begin; place < range.end; ++place) {
        ScatteredRoot& root = roots[grid.point_at(place)];
        const dvec3 normal(surface.triangles[root.triangle].normal);
        SurfaceWalk walk(surface, root);
        walk.walk(repulsion(grid, grid.position_at(place), normal, reach_m));
        root = walk.root();
      }
    });
  }
}

}  // namespace gloam
