// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <glm/ext/vector_double2.hpp>
#include <limits>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

struct QuadSettings;

/// Box in a plane's coordinates, metres. The default box is empty.
struct PlaneBox {
  glm::dvec2 min = glm::dvec2(std::numeric_limits<double>::infinity());
  glm::dvec2 max = glm::dvec2(-std::numeric_limits<double>::infinity());
  void grow(const glm::dvec2& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
};

/// Corners in a plane's coordinates: x and y in the plane, z the distance in front of it; metres.
using PlaneTriangle = std::array<dvec3, 3>;

/// Surface near a plane, sampled at one point of each square cell.
class SurfaceGrid {
 public:
  static constexpr std::size_t kLargestSide = 1024;  ///< cells; larger boxes get larger cells

  /// box: not empty, finite. cell_m: > 0.
  SurfaceGrid(const PlaneBox& box, double cell_m);

  /// Marks the cells whose sample points the triangle covers. Where surfaces lie in front of each other, the foremost
  /// counts.
  void add(const PlaneTriangle& triangle);

  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] std::size_t rows() const { return rows_; }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] const PlaneBox& box() const { return box_; }
  [[nodiscard]] bool covered(std::size_t column, std::size_t row) const { return depth_m(column, row) > kNothing; }
  /// Distance of the foremost surface in front of the plane, metres. The cell must be covered.
  [[nodiscard]] double depth_m(std::size_t column, std::size_t row) const { return depths_m_[row * columns_ + column]; }

 private:
  static constexpr double kNothing = -std::numeric_limits<double>::infinity();
  PlaneBox box_;
  double cell_m_;
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<double> depths_m_;
};

/// A rectangle of cells with enough surface.
struct SurfaceRectangle {
  PlaneBox box;
  double covered_m2 = 0.0;
  double depth_m = 0.0;  ///< mean distance of its foremost surface in front of the plane
};

/// Divides the surface into rectangles by the sides, areas and coverage of `settings`. Pieces with a gap between them
/// are separated. A rectangle with too little surface is cut where the tight rectangles of both parts are smallest; one
/// that is too long is cut into equal parts.
[[nodiscard]] std::vector<SurfaceRectangle> divide_surface(const SurfaceGrid& grid, const QuadSettings& settings);

}  // namespace gloam
