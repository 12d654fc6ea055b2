// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/scenes/meadow/ground.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace gloam {
namespace {

constexpr int kFieldRows = 96;
constexpr int kSideColumns = 46;  // of the field, on each side of the path
constexpr int kPathColumns = 6;
constexpr int kHillCells = 18;  // from the field's border outwards
constexpr double kFirstHillCell = 0.4;
constexpr double kHillGrowth = 1.16;

constexpr int kRows = kFieldRows + 2 * kHillCells;
constexpr int kColumns = 2 * (kSideColumns + kHillCells) + kPathColumns;

double smooth_step(double from, double to, double x) {
  const double t = glm::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// Distance from the field's border to the outer side of hill cell number `cells`.
double hill_distance(int cells) { return kFirstHillCell * (std::pow(kHillGrowth, cells) - 1.0) / (kHillGrowth - 1.0); }

double path_width(double z) { return 1.15 + 0.1 * std::sin(1.3 * z + 1.0); }

double row_z(int row) {
  if (row < kHillCells) return -kMeadowEdge - hill_distance(kHillCells - row);
  if (row > kHillCells + kFieldRows) return kMeadowEdge + hill_distance(row - kHillCells - kFieldRows);
  return kMeadowEdge * (2.0 * (row - kHillCells) / kFieldRows - 1.0);
}

/// Columns follow the path, so that its sides are edges of cells.
double column_x(int column, double z) {
  const double left = meadow_path_x(z) - 0.5 * path_width(z), right = left + path_width(z);
  if (column < kHillCells) return -kMeadowEdge - hill_distance(kHillCells - column);
  column -= kHillCells;
  if (column <= kSideColumns) return glm::mix(-kMeadowEdge, left, static_cast<double>(column) / kSideColumns);
  column -= kSideColumns;
  if (column <= kPathColumns) return glm::mix(left, right, static_cast<double>(column) / kPathColumns);
  column -= kPathColumns;
  if (column <= kSideColumns) return glm::mix(right, kMeadowEdge, static_cast<double>(column) / kSideColumns);
  return kMeadowEdge + hill_distance(column - kSideColumns);
}

enum class Part { field, path, hills };

Part part_of(int row, int column) {
  const int from_field = column - kHillCells;
  if (from_field >= kSideColumns && from_field < kSideColumns + kPathColumns) return Part::path;
  const bool in_rows = row >= kHillCells && row < kHillCells + kFieldRows;
  const bool in_columns = from_field >= 0 && from_field < 2 * kSideColumns + kPathColumns;
  return in_rows && in_columns ? Part::field : Part::hills;
}

/// Factor of the ground's colour: drier and moister places.
vec4 tint(double x, double z) {
  const double patches = std::sin(0.9 * x + 1.7 * std::sin(0.6 * z)) * std::sin(0.8 * z - 1.3 * std::sin(0.5 * x));
  const double specks = std::sin(7.3 * x + 2.0 * z) * std::sin(6.1 * z - 3.0 * x);
  const auto dry = static_cast<float>(0.5 + 0.35 * patches + 0.15 * specks);
  return glm::mix(vec4(0.72f, 0.86f, 0.62f, 1.0f), vec4(1.0f, 0.94f, 0.9f, 1.0f), dry);
}

Primitive part_shape(Part part) {
  Primitive out;
  std::vector<std::uint32_t> placed((kRows + 1) * (kColumns + 1), kNone);
  const auto vertex = [&](int row, int column) {
    std::uint32_t& index = placed[static_cast<std::size_t>(row * (kColumns + 1) + column)];
    if (index != kNone) return index;
    index = static_cast<std::uint32_t>(out.positions.size());
    const double z = row_z(row), x = column_x(column, z);
    out.positions.emplace_back(meadow_point(x, z));
    out.normals.emplace_back(meadow_normal(x, z));
    out.colors.push_back(tint(x, z));
    out.bounds.grow(out.positions.back());
    return index;
  };
  for (int row = 0; row < kRows; ++row) {
    for (int column = 0; column < kColumns; ++column) {
      if (part_of(row, column) != part) continue;
      const std::uint32_t a = vertex(row, column), b = vertex(row + 1, column);
      const std::uint32_t c = vertex(row + 1, column + 1), d = vertex(row, column + 1);
      out.indices.insert(out.indices.end(), {a, b, d, d, b, c});
    }
  }
  return out;
}

}  // namespace

double meadow_path_x(double z) { return 1.1 * std::sin(0.3 * z + 0.4); }

double meadow_height(double x, double z) {
  const double waves =
      0.26 * std::sin(0.45 * x + 0.6) * std::cos(0.38 * z - 0.4) + 0.10 * std::sin(0.8 * x - 0.55 * z + 1.1);
  const double worn = -0.05 * (1.0 - smooth_step(0.2, 1.2, std::abs(x - meadow_path_x(z))));
  const double far = smooth_step(kMeadowEdge + 0.5, 45.0, std::hypot(x, z));
  const double hills = 0.5 + 0.5 * std::sin(0.16 * x + 1.0) * std::cos(0.14 * z + 0.5);
  // A low hill beyond a corner of the field, from which the camera "far" looks.
  const double knoll = 1.8 * std::exp(-((x + 15.5) * (x + 15.5) + (z - 15.5) * (z - 15.5)) / 16.0);
  return waves + worn + far * (2.0 + 4.0 * hills) + knoll;
}

dvec3 meadow_point(double x, double z, double above) { return {x, meadow_height(x, z) + above, z}; }

dvec3 meadow_normal(double x, double z) {
  constexpr double kStep = 0.01;
  const double slope_x = (meadow_height(x + kStep, z) - meadow_height(x - kStep, z)) / (2.0 * kStep);
  const double slope_z = (meadow_height(x, z + kStep) - meadow_height(x, z - kStep)) / (2.0 * kStep);
  return glm::normalize(dvec3(-slope_x, 1.0, -slope_z));
}

MeadowGround meadow_ground_shapes() {
  return {.field = part_shape(Part::field), .path = part_shape(Part::path), .hills = part_shape(Part::hills)};
}

double upward_area_m2(const Primitive& shape) {
  double area = 0.0;
  for (std::size_t i = 0; i < shape.indices.size(); i += 3) {
    const dvec3 a(shape.positions[shape.indices[i]]);
    const dvec3 b(shape.positions[shape.indices[i + 1]]);
    const dvec3 c(shape.positions[shape.indices[i + 2]]);
    const dvec3 normal = glm::cross(b - a, c - a);
    if (normal.y > 0.0) area += 0.5 * glm::length(normal);
  }
  return area;
}

}  // namespace gloam
