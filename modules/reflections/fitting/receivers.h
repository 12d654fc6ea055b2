// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

struct UpTriangle {
  dvec3 corners[3];  ///< world, metres
};

/// Triangles that face up, for sampling by area and for finding the one at a point.
class UpTriangles {
 public:
  /// Keeps those with an area, and with a normal that is nearly up: n.y ≥ kLeastNormalY.
  explicit UpTriangles(std::span<const UpTriangle> triangles);

  static constexpr double kLeastNormalY = 0.9;

  [[nodiscard]] bool empty() const { return triangles_.empty(); }
  [[nodiscard]] double area_m2() const { return areas_.empty() ? 0.0 : areas_.back(); }
  /// A point by area. pick, u, v: in [0, 1). Must not be empty.
  [[nodiscard]] dvec3 sample(double pick, double u, double v) const;
  /// The height of the triangle at the point's x and z that is nearest to it and within slack_m of its height.
  [[nodiscard]] std::optional<double> height_at(const dvec3& point, double slack_m) const;

 private:
  void build_cells();
  [[nodiscard]] std::size_t cell_index(double x, double z) const;

  std::vector<UpTriangle> triangles_;
  std::vector<double> areas_;  // running sum
  // A grid over x and z: the triangles of cell i are cell_triangles_[cell_first_[i]] up to [cell_first_[i + 1]].
  double low_x_ = 0.0;
  double low_z_ = 0.0;
  double cell_m_ = 1.0;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<std::uint32_t> cell_first_;
  std::vector<std::uint32_t> cell_triangles_;
};

}  // namespace gloam
