// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/growth/curve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace gloam {
namespace {

/// Place of a cell of a 65,536² grid on the Hilbert curve.
std::uint32_t hilbert_place(std::uint32_t x, std::uint32_t y) {
  std::uint32_t place = 0;
  for (std::uint32_t bit = 1u << 15; bit > 0; bit >>= 1) {
    const std::uint32_t right = (x & bit) != 0 ? 1u : 0u;
    const std::uint32_t up = (y & bit) != 0 ? 1u : 0u;
    place = place << 2 | ((3u * right) ^ up);
    if (up != 0) continue;
    if (right != 0) {
      x = ~x;
      y = ~y;
    }
    std::swap(x, y);
  }
  return place;
}

/// Triangles by the Hilbert places of their centroids, seen from above.
std::vector<std::uint32_t> hilbert_order(const std::vector<GrowthTriangle>& triangles) {
  const auto centroid = [](const GrowthTriangle& t) { return (t.corners[0] + t.corners[1] + t.corners[2]) / 3.0; };
  dvec3 from(std::numeric_limits<double>::infinity());
  dvec3 to = -from;
  for (const GrowthTriangle& t : triangles) {
    from = glm::min(from, centroid(t));
    to = glm::max(to, centroid(t));
  }
  const double size = std::max({to.x - from.x, to.z - from.z, 1e-300});
  std::vector<std::uint64_t> keys(triangles.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const dvec3 at = (centroid(triangles[i]) - from) * (65535.0 / size);
    const std::uint32_t place = hilbert_place(static_cast<std::uint32_t>(at.x), static_cast<std::uint32_t>(at.z));
    keys[i] = std::uint64_t{place} << 32 | i;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = static_cast<std::uint32_t>(keys[i]);
  return order;
}

/// Barycentric weights of corners 1 and 2.
struct Weights {
  double u = 0.0;
  double v = 0.0;
};
Weights middle(const Weights& a, const Weights& b) { return {0.5 * (a.u + b.u), 0.5 * (a.v + b.v)}; }

/// Halves a part of a triangle along its longest edge.
class Halving {
 public:
  explicit Halving(const GrowthTriangle& triangle) {
    const dvec3 e1 = triangle.corners[1] - triangle.corners[0];
    const dvec3 e2 = triangle.corners[2] - triangle.corners[0];
    g11_ = glm::dot(e1, e1);
    g12_ = glm::dot(e1, e2);
    g22_ = glm::dot(e2, e2);
  }

  /// Keeps the first or the second half.
  void halve(bool second) {
    const double ab = squared(corners_[0], corners_[1]);
    const double bc = squared(corners_[1], corners_[2]);
    const double ca = squared(corners_[2], corners_[0]);
    const std::size_t longest = ab >= bc && ab >= ca ? 0 : bc >= ca ? 1 : 2;
    const std::size_t next = (longest + 1) % 3;
    // Halves keep the winding, so that cuts of equal edges turn in the same direction.
    corners_[second ? longest : next] = middle(corners_[longest], corners_[next]);
  }

  /// A point of the part, for u and v uniform in [0, 1).
  [[nodiscard]] Weights point(double u, double v) const {
    if (u + v > 1.0) {
      u = 1.0 - u;
      v = 1.0 - v;
    }
    const Weights& a = corners_[0];
    return {a.u + u * (corners_[1].u - a.u) + v * (corners_[2].u - a.u),
            a.v + u * (corners_[1].v - a.v) + v * (corners_[2].v - a.v)};
  }

 private:
  [[nodiscard]] double squared(const Weights& a, const Weights& b) const {
    const double u = b.u - a.u;
    const double v = b.v - a.v;
    return g11_ * u * u + 2.0 * g12_ * u * v + g22_ * v * v;
  }

  std::array<Weights, 3> corners_ = {Weights{0.0, 0.0}, Weights{1.0, 0.0}, Weights{0.0, 1.0}};
  double g11_ = 0.0;
  double g12_ = 0.0;
  double g22_ = 0.0;
};

}  // namespace

AreaCurve::AreaCurve(const GrowthSurface& surface) : surface_(surface), order_(hilbert_order(surface.triangles)) {
  ends_.reserve(order_.size());
  double end = 0.0;
  for (const std::uint32_t triangle : order_) ends_.push_back(end += surface.triangles[triangle].area_m2);
}

ScatteredRoot AreaCurve::root(std::uint32_t index, std::uint32_t count, BladeRandom random) const {
  const double part = ends_.back() / count;
  const double at = (index + random.unit()) * part;
  const auto found = std::upper_bound(ends_.begin(), ends_.end() - 1, at);
  const auto place = static_cast<std::size_t>(found - ends_.begin());
  const GrowthTriangle& triangle = surface_.triangles[order_[place]];
  const double begin = place == 0 ? 0.0 : ends_[place - 1];
  double share = std::clamp((at - begin) / (ends_[place] - begin), 0.0, 1.0);
  Halving halving(triangle);
  // The last halves are small against the part of the path, so a random point in them keeps the sample stratified.
  for (double area = triangle.area_m2; area > part / 64.0; area *= 0.5) {
    const bool second = share >= 0.5;
    share = 2.0 * share - (second ? 1.0 : 0.0);
    halving.halve(second);
  }
  const double u = random.unit();
  const double v = random.unit();
  const Weights weights = halving.point(u, v);
  ScatteredRoot root{order_[place], std::clamp(weights.u, 0.0, 1.0), 0.0};
  root.weight2 = std::clamp(weights.v, 0.0, 1.0 - root.weight1);
  return root;
}

}  // namespace gloam
