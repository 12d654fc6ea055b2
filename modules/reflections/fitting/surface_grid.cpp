// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/fitting/surface_grid.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "modules/reflections/fitting/region_quads.h"

namespace gloam {
namespace {

/// Cells [left, right) × [bottom, top).
struct CellBox {
  std::size_t left = 0;
  std::size_t bottom = 0;
  std::size_t right = 0;
  std::size_t top = 0;
  [[nodiscard]] bool empty() const { return left >= right || bottom >= top; }
  [[nodiscard]] std::size_t area() const { return empty() ? 0 : (right - left) * (top - bottom); }
  void grow(const CellBox& other) {
    if (other.empty()) return;
    if (empty()) {
      *this = other;
      return;
    }
    left = std::min(left, other.left);
    bottom = std::min(bottom, other.bottom);
    right = std::max(right, other.right);
    top = std::max(top, other.top);
  }
};

/// The tight box of each column of `box`, or of each row.
std::vector<CellBox> line_boxes(const SurfaceGrid& grid, const CellBox& box, bool columns) {
  std::vector<CellBox> lines(columns ? box.right - box.left : box.top - box.bottom);
  for (std::size_t row = box.bottom; row < box.top; ++row)
    for (std::size_t column = box.left; column < box.right; ++column)
      if (grid.covered(column, row))
        lines[columns ? column - box.left : row - box.bottom].grow({column, row, column + 1, row + 1});
  return lines;
}

struct Cut {
  CellBox first;
  CellBox second;
  [[nodiscard]] std::size_t area() const { return first.area() + second.area(); }
};

/// The cut between two lines that leaves the smallest tight boxes; the middle one of equal cuts.
std::optional<Cut> best_cut(std::span<const CellBox> lines) {
  std::vector<CellBox> after(lines.size() + 1);
  for (std::size_t i = lines.size(); i-- > 0;) {
    after[i] = after[i + 1];
    after[i].grow(lines[i]);
  }
  std::optional<Cut> best;
  CellBox before;
  const auto distance = [&](std::size_t i) {
    return 2 * i > lines.size() ? 2 * i - lines.size() : lines.size() - 2 * i;
  };
  std::size_t best_distance = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    before.grow(lines[i - 1]);
    const Cut cut{before, after[i]};
    if (best && (cut.area() > best->area() || (cut.area() == best->area() && distance(i) >= best_distance))) continue;
    best = cut;
    best_distance = distance(i);
  }
  return best;
}

/// The cut at the longest run of empty lines, if that is longer than `least` lines. The lines at both ends hold
/// surface.
std::optional<Cut> gap_cut(std::span<const CellBox> lines, std::size_t least) {
  std::size_t longest = least, end = 0;
  std::size_t run = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    run = lines[i].empty() ? run + 1 : 0;
    if (run <= longest) continue;
    longest = run;
    end = i + 1;
  }
  if (end == 0) return std::nullopt;
  Cut cut;
  for (const CellBox& line : lines.first(end)) cut.first.grow(line);
  for (const CellBox& line : lines.subspan(end)) cut.second.grow(line);
  return cut;
}

/// Where a cell is sampled, in cells from its lower left corner. Samples at the same place of all cells would miss the
/// bricks of a wall whose rows are about as high as a cell.
glm::dvec2 sample_place(std::size_t column, std::size_t row) {
  // The R2 sequence of M. Roberts, one step a column and another one a row.
  constexpr double kStepA = 0.7548776662466927, kStepB = 0.5698402909980532;
  const auto c = static_cast<double>(column), r = static_cast<double>(row);
  const glm::dvec2 at(0.5 + kStepA * c + kStepB * r, 0.5 + kStepB * c - kStepA * r);
  return at - glm::floor(at);
}

class SurfaceDivider {
 public:
  SurfaceDivider(const SurfaceGrid& grid, const QuadSettings& settings) : grid_(grid), settings_(settings) {}

  void divide(const CellBox& wanted) {
    CellBox box;
    for (const CellBox& line : line_boxes(grid_, wanted, true)) box.grow(line);
    if (box.empty()) return;
    const double width = static_cast<double>(box.right - box.left) * grid_.cell_m();
    const double height = static_cast<double>(box.top - box.bottom) * grid_.cell_m();
    // A wall's edge may lie up to a cell beyond the last sample.
    const double least_side = settings_.min_side_m - grid_.cell_m();
    const SurfaceRectangle rectangle = measure(box);
    if (width < least_side || height < least_side || rectangle.covered_m2 < settings_.min_area_m2) return;
    const double coverage = rectangle.covered_m2 / (width * height);
    const bool fits = width <= settings_.max_side_m + grid_.cell_m() && height <= settings_.max_side_m + grid_.cell_m();
    const auto gap = static_cast<std::size_t>(settings_.gap_m / grid_.cell_m());
    std::optional<Cut> apart = gap_cut(line_boxes(grid_, box, true), gap);
    if (!apart) apart = gap_cut(line_boxes(grid_, box, false), gap);
    const bool whole = fits && !apart && coverage >= settings_.min_coverage;
    if (whole || (settings_.with_divided && fits && coverage >= 0.5 * settings_.min_coverage))
      rectangles.push_back(rectangle);
    if (whole && !(settings_.with_divided && coverage < kFull)) return;
    if (!apart) return cut_up(box, width, height);
    divide(apart->first);
    divide(apart->second);
  }

  std::vector<SurfaceRectangle> rectangles;

 private:
  static constexpr double kFull = 0.9;        ///< coverage above which a rectangle is never divided
  static constexpr double kLeastGain = 0.05;  ///< share of the area that a cut at a gap must save

  void cut_up(const CellBox& box, double width, double height) {
    std::optional<Cut> cut = best_cut(line_boxes(grid_, box, true));
    if (const std::optional<Cut> across = best_cut(line_boxes(grid_, box, false));
        across && (!cut || across->area() < cut->area()))
      cut = across;
    const auto area = static_cast<double>(box.area());
    if (cut && static_cast<double>(cut->area()) <= (1.0 - kLeastGain) * area) {
      divide(cut->first);
      divide(cut->second);
      return;
    }
    const bool along_u = width >= height;
    const std::size_t length = along_u ? box.right - box.left : box.top - box.bottom;
    const auto needed =
        static_cast<std::size_t>(std::ceil((along_u ? width : height) / (settings_.max_side_m + grid_.cell_m())));
    const std::size_t parts = std::max<std::size_t>(needed, 2);
    if (length < parts) return;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t from = length * part / parts, to = length * (part + 1) / parts;
      CellBox piece = box;
      (along_u ? piece.left : piece.bottom) = (along_u ? box.left : box.bottom) + from;
      (along_u ? piece.right : piece.top) = (along_u ? box.left : box.bottom) + to;
      divide(piece);
    }
  }

  [[nodiscard]] SurfaceRectangle measure(const CellBox& box) const {
    SurfaceRectangle rectangle;
    std::size_t count = 0;
    double depths = 0.0;
    for (std::size_t row = box.bottom; row < box.top; ++row)
      for (std::size_t column = box.left; column < box.right; ++column) {
        if (!grid_.covered(column, row)) continue;
        ++count;
        depths += grid_.depth_m(column, row);
      }
    const double cell = grid_.cell_m();
    rectangle.covered_m2 = static_cast<double>(count) * cell * cell;
    rectangle.depth_m = depths / static_cast<double>(std::max<std::size_t>(count, 1));
    const auto at = [&](std::size_t column, std::size_t row) {
      return grid_.box().min + cell * glm::dvec2(static_cast<double>(column), static_cast<double>(row));
    };
    rectangle.box.min = at(box.left, box.bottom);
    rectangle.box.max = glm::min(at(box.right, box.top), grid_.box().max);
    return rectangle;
  }

  const SurfaceGrid& grid_;
  const QuadSettings& settings_;
};

}  // namespace

SurfaceGrid::SurfaceGrid(const PlaneBox& box, double cell_m) : box_(box), cell_m_(cell_m) {
  const glm::dvec2 size = box.max - box.min;
  cell_m_ = std::max(cell_m, std::max(size.x, size.y) / static_cast<double>(kLargestSide));
  const auto cells = [&](double length) {
    return std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(length / cell_m_)), 1, kLargestSide);
  };
  columns_ = cells(size.x);
  rows_ = cells(size.y);
  depths_m_.assign(columns_ * rows_, kNothing);
}

void SurfaceGrid::add(const PlaneTriangle& triangle) {
  const auto local = [&](const dvec3& p) { return (glm::dvec2(p.x, p.y) - box_.min) / cell_m_; };
  const glm::dvec2 a = local(triangle[0]), b = local(triangle[1]), c = local(triangle[2]);
  const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
  if (!(std::abs(area) > 1e-12)) return;
  const auto first = [](double low) { return static_cast<std::size_t>(std::max(0.0, std::floor(low))); };
  const auto last = [](double high, std::size_t count) {
    return static_cast<std::size_t>(std::clamp(std::floor(high) + 1.0, 0.0, static_cast<double>(count)));
  };
  const std::size_t right = last(std::max({a.x, b.x, c.x}), columns_);
  const std::size_t top = last(std::max({a.y, b.y, c.y}), rows_);
  for (std::size_t row = first(std::min({a.y, b.y, c.y})); row < top; ++row)
    for (std::size_t column = first(std::min({a.x, b.x, c.x})); column < right; ++column) {
      const glm::dvec2 p =
          sample_place(column, row) + glm::dvec2(static_cast<double>(column), static_cast<double>(row));
      const double at_b = ((p.x - a.x) * (c.y - a.y) - (p.y - a.y) * (c.x - a.x)) / area;
      const double at_c = ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / area;
      if (at_b < 0.0 || at_c < 0.0 || at_b + at_c > 1.0) continue;
      const double depth =
          triangle[0].z + at_b * (triangle[1].z - triangle[0].z) + at_c * (triangle[2].z - triangle[0].z);
      double& cell = depths_m_[row * columns_ + column];
      cell = std::max(cell, depth);
    }
}

std::vector<SurfaceRectangle> divide_surface(const SurfaceGrid& grid, const QuadSettings& settings) {
  SurfaceDivider divider(grid, settings);
  divider.divide({0, 0, grid.columns(), grid.rows()});
  return std::move(divider.rectangles);
}

}  // namespace gloam
