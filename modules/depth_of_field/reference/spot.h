// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// The spot that one bright pixel of a dark picture becomes.
class Spot {
 public:
  Spot(int width, int height, std::vector<double> values) : width_(width), height_(height), values_(std::move(values)) {
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        energy_ += value(x, y);
        centre_ += value(x, y) * glm::dvec2(x, y);
      }
    centre_ /= energy_;
  }

  [[nodiscard]] double energy() const { return energy_; }
  [[nodiscard]] glm::dvec2 centre() const { return centre_; }
  /// Second moments about the centre, per energy: xx, yy, xy.
  [[nodiscard]] dvec3 moments() const {
    dvec3 sum(0.0);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) {
        const glm::dvec2 d = glm::dvec2(x, y) - centre_;
        sum += value(x, y) * dvec3(d.x * d.x, d.y * d.y, d.x * d.y);
      }
    return sum / energy_;
  }
  /// Mean of the pixels within a distance of the centre.
  [[nodiscard]] double mean_within(double radius) const {
    double sum = 0.0;
    int count = 0;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        if (glm::distance(glm::dvec2(x, y), centre_) <= radius) {
          sum += value(x, y);
          ++count;
        }
    return sum / count;
  }
  /// The least and the greatest pixel within a distance of the centre.
  [[nodiscard]] glm::dvec2 range_within(double radius) const {
    glm::dvec2 range(1e300, -1e300);
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x)
        if (glm::distance(glm::dvec2(x, y), centre_) <= radius)
          range = {std::min(range.x, value(x, y)), std::max(range.y, value(x, y))};
    return range;
  }
  /// The place farthest from the centre at which the interpolated value reaches a level, in the direction of an angle.
  [[nodiscard]] glm::dvec2 outline(double angle, double level) const {
    const glm::dvec2 along(std::cos(angle), std::sin(angle));
    double distance = 0.5 * width_;
    while (distance > 0.0 && at(centre_ + distance * along) < level) distance -= 0.02;
    return centre_ + distance * along;
  }

 private:
  [[nodiscard]] double value(int x, int y) const {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return 0.0;
    return values_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }
  [[nodiscard]] double at(const glm::dvec2& place) const {
    const int x = static_cast<int>(std::floor(place.x)), y = static_cast<int>(std::floor(place.y));
    const double s = place.x - x, t = place.y - y;
    return (value(x, y) * (1.0 - s) + value(x + 1, y) * s) * (1.0 - t) +
           (value(x, y + 1) * (1.0 - s) + value(x + 1, y + 1) * s) * t;
  }

  int width_;
  int height_;
  std::vector<double> values_;
  double energy_ = 0.0;
  glm::dvec2 centre_ = glm::dvec2(0.0);
};

/// A line through points by least squares: its points p have dot(normal, p) = offset.
struct FittedLine {
  glm::dvec2 normal = glm::dvec2(0.0);
  double offset = 0.0;
};
[[nodiscard]] inline FittedLine fit_line(const std::vector<glm::dvec2>& points) {
  glm::dvec2 mean(0.0);
  for (const glm::dvec2& p : points) mean += p / static_cast<double>(points.size());
  double xx = 0.0, yy = 0.0, xy = 0.0;
  for (const glm::dvec2& p : points) {
    const glm::dvec2 d = p - mean;
    xx += d.x * d.x;
    yy += d.y * d.y;
    xy += d.x * d.y;
  }
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);  // of the line
  const glm::dvec2 normal(-std::sin(angle), std::cos(angle));
  return {normal, glm::dot(normal, mean)};
}

/// Corners of a hexagon with corners at the top and the bottom, from the outline of a spot at a level: lines are fitted
/// to the middles of its sides.
[[nodiscard]] inline std::array<glm::dvec2, 6> hexagon_corners(const Spot& spot, double level) {
  std::array<FittedLine, 6> sides;
  for (int side = 0; side < 6; ++side) {
    std::vector<glm::dvec2> points;
    for (int degree = -18; degree <= 18; ++degree)
      points.push_back(spot.outline((60.0 * side + degree) * std::numbers::pi / 180.0, level));
    sides[static_cast<std::size_t>(side)] = fit_line(points);
  }
  std::array<glm::dvec2, 6> corners;
  for (std::size_t i = 0; i < 6; ++i) {
    const FittedLine &a = sides[i], &b = sides[(i + 1) % 6];
    const double determinant = a.normal.x * b.normal.y - a.normal.y * b.normal.x;
    corners[i] =
        glm::dvec2(a.offset * b.normal.y - b.offset * a.normal.y, a.normal.x * b.offset - b.normal.x * a.offset) /
        determinant;
  }
  return corners;
}

}  // namespace gloam
