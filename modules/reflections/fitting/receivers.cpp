// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/receivers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/math/finite.h"

namespace gloam {
namespace {

constexpr std::size_t kLargestSide = 256;  // cells

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void grow(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

Extent extent_of(const UpTriangle& triangle, int axis) {
  Extent extent;
  for (const dvec3& corner : triangle.corners) extent.grow(corner[axis]);
  return extent;
}

/// The height of the triangle's plane at x and z, if the triangle is there.
std::optional<double> height_in(const UpTriangle& t, double x, double z) {
  const dvec3 ab = t.corners[1] - t.corners[0], ac = t.corners[2] - t.corners[0];
  const double px = x - t.corners[0].x, pz = z - t.corners[0].z;
  const double area = ab.x * ac.z - ab.z * ac.x;
  constexpr double kSlack = 1e-6;
  const double at_b = (px * ac.z - pz * ac.x) / area;
  const double at_c = (ab.x * pz - ab.z * px) / area;
  if (!(at_b >= -kSlack && at_c >= -kSlack && at_b + at_c <= 1.0 + kSlack)) return std::nullopt;
  return t.corners[0].y + at_b * ab.y + at_c * ac.y;
}

}  // namespace

UpTriangles::UpTriangles(std::span<const UpTriangle> triangles) {
  double sum = 0.0;
  for (const UpTriangle& t : triangles) {
    const dvec3 cross = glm::cross(t.corners[1] - t.corners[0], t.corners[2] - t.corners[0]);
    const double length = glm::length(cross);
    if (!std::isfinite(length) || !(length > 1e-9) || cross.y < kLeastNormalY * length) continue;
    triangles_.push_back(t);
    sum += 0.5 * length;
    areas_.push_back(sum);
  }
  if (!triangles_.empty()) build_cells();
}

void UpTriangles::build_cells() {
  Extent xs, zs;
  for (const UpTriangle& t : triangles_)
    for (const dvec3& corner : t.corners) {
      xs.grow(corner.x);
      zs.grow(corner.z);
    }
  low_x_ = xs.low;
  low_z_ = zs.low;
  cell_m_ = std::max(1.0, std::max(xs.high - xs.low, zs.high - zs.low) / static_cast<double>(kLargestSide - 1));
  columns_ = static_cast<std::size_t>((xs.high - xs.low) / cell_m_) + 1;
  rows_ = static_cast<std::size_t>((zs.high - zs.low) / cell_m_) + 1;
  const auto each_cell = [&](const UpTriangle& t, const auto& visit) {
    const Extent x = extent_of(t, 0), z = extent_of(t, 2);
    const std::size_t first = cell_index(x.low, z.low), last = cell_index(x.high, z.high);
    for (std::size_t row = first / columns_; row <= last / columns_; ++row)
      for (std::size_t column = first % columns_; column <= last % columns_; ++column) visit(row * columns_ + column);
  };
  cell_first_.assign(columns_ * rows_ + 1, 0);
  for (const UpTriangle& t : triangles_) each_cell(t, [&](std::size_t cell) { ++cell_first_[cell + 1]; });
  for (std::size_t i = 1; i < cell_first_.size(); ++i) cell_first_[i] += cell_first_[i - 1];
  cell_triangles_.resize(cell_first_.back());
  std::vector<std::uint32_t> next(cell_first_.begin(), cell_first_.end() - 1);
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    each_cell(triangles_[i], [&](std::size_t cell) { cell_triangles_[next[cell]++] = static_cast<std::uint32_t>(i); });
}

std::size_t UpTriangles::cell_index(double x, double z) const {
  const auto at = [&](double offset, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(offset / cell_m_), 0.0, static_cast<double>(count - 1)));
  };
  return at(z - low_z_, rows_) * columns_ + at(x - low_x_, columns_);
}

dvec3 UpTriangles::sample(double pick, double u, double v) const {
  const auto found = std::ranges::upper_bound(areas_, pick * areas_.back());
  const auto index = std::min<std::size_t>(static_cast<std::size_t>(found - areas_.begin()), triangles_.size() - 1);
  const dvec3(&c)[3] = triangles_[index].corners;
  const double root = std::sqrt(u);
  return c[0] * (1.0 - root) + c[1] * (root * (1.0 - v)) + c[2] * (root * v);
}

std::optional<double> UpTriangles::height_at(const dvec3& point, double slack_m) const {
  std::optional<double> nearest;
  if (triangles_.empty() || !is_finite(point)) return nearest;
  const std::size_t cell = cell_index(point.x, point.z);
  for (std::uint32_t i = cell_first_[cell]; i < cell_first_[cell + 1]; ++i) {
    const std::optional<double> height = height_in(triangles_[cell_triangles_[i]], point.x, point.z);
    if (!height || std::abs(*height - point.y) > slack_m) continue;
    if (!nearest || std::abs(*height - point.y) < std::abs(*nearest - point.y)) nearest = height;
  }
  return nearest;
}

}  // namespace gloam
