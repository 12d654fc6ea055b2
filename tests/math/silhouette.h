// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/math/bounds.h"

/// Brute-force oracle of screen bounds, in double. A convex body is given by a function that returns its support point:
/// the point of the body that lies farthest in a direction. Every point used belongs to the body, so the oracle never
/// exceeds the true bounds.
namespace gloam::test {

using SupportPoint = std::function<dvec3(dvec3 direction)>;

inline SupportPoint support_of(const Sphere& sphere) {
  return [=](dvec3 direction) { return dvec3(sphere.center) + static_cast<double>(sphere.radius) * direction; };
}

/// A unit vector perpendicular to `axis`.
inline dvec3 any_across(dvec3 axis) {
  const dvec3 helper = std::abs(axis.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  return glm::normalize(glm::cross(axis, helper));
}

inline SupportPoint support_of(const Cone& cone) {
  return [=](dvec3 direction) {
    const dvec3 apex(cone.apex);
    const dvec3 axis = glm::normalize(dvec3(cone.axis));
    const double range = cone.range_m;
    const double half_angle = std::min<double>(cone.half_angle, std::acos(0.0));
    const double along = glm::dot(direction, axis);
    const dvec3 rest = direction - along * axis;
    const double angle = std::atan2(glm::length(rest), along);
    if (angle <= half_angle) return apex + range * direction;
    const dvec3 side = glm::length(rest) > 1e-12 ? glm::normalize(rest) : any_across(axis);
    const dvec3 rim = apex + range * (std::cos(half_angle) * axis + std::sin(half_angle) * side);
    return glm::dot(rim - apex, direction) > 0.0 ? rim : apex;
  };
}

/// Extent of the body on one screen axis (0 or 1) to the given side (1 or -1): the greatest side · x / d over its part
/// with d ≥ near, or -infinity if that part is empty.
inline double reach(const SupportPoint& support, int axis, double side, double near_m) {
  constexpr double kHalfPi = 1.57079632679489661923;
  struct Point {
    double x;
    double d;
  };
  // As `turn` goes from -π/2 to π/2, the direction turns from backward over sideways to forward, and its support point
  // follows the silhouette from the least to the greatest depth.
  const auto at = [&](double turn) {
    dvec3 direction(0.0, 0.0, -std::sin(turn));
    direction[axis] = side * std::cos(turn);
    const dvec3 p = support(direction);
    return Point{side * p[axis], -p.z};
  };
  if (at(kHalfPi).d < near_m) return -std::numeric_limits<double>::infinity();
  double best = at(kHalfPi).x / at(kHalfPi).d;
  double low = -kHalfPi;
  double high = kHalfPi;
  if (at(low).d < near_m) {
    for (int i = 0; i < 80; ++i) {
      const double middle = 0.5 * (low + high);
      (at(middle).d < near_m ? low : high) = middle;
    }
    const Point behind = at(low);
    const Point front = at(high);
    // The segment between two points of a convex body lies in the body.
    const double share = (near_m - behind.d) / (front.d - behind.d);
    best = std::max(best, (behind.x + share * (front.x - behind.x)) / near_m);
    low = high;
  }
  const auto slope = [&](double turn) {
    const Point p = at(turn);
    return p.d >= near_m ? p.x / p.d : -std::numeric_limits<double>::infinity();
  };
  constexpr int kSteps = 256;
  const double step = (kHalfPi - low) / kSteps;
  int best_step = 0;
  for (int i = 0; i <= kSteps; ++i) {
    if (slope(low + i * step) > slope(low + best_step * step)) best_step = i;
  }
  double left = low + std::max(best_step - 1, 0) * step;
  double right = low + std::min(best_step + 1, kSteps) * step;
  for (int i = 0; i < 100; ++i) {
    const double a = left + (right - left) / 3.0;
    const double b = right - (right - left) / 3.0;
    best = std::max({best, slope(a), slope(b)});
    (slope(a) < slope(b) ? left : right) = slope(a) < slope(b) ? a : b;
  }
  return best;
}

/// Visits points of the body with d ≥ near: the support points of evenly spread directions, and the points where
/// segments between consecutive support points cross the near plane.
template <class Visit>
void sample_surface(const SupportPoint& support, double near_m, int count, Visit&& visit) {
  dvec3 before = support(dvec3(0.0, 0.0, 1.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / count;
    const double across = std::sqrt(1.0 - z * z);
    const double angle = i * 2.39996322972865332;  // the golden angle spreads directions evenly
    const dvec3 p = support(dvec3(across * std::cos(angle), across * std::sin(angle), z));
    if (-p.z >= near_m) visit(p);
    if ((-p.z < near_m) != (-before.z < near_m)) {
      dvec3 cut = before + ((-near_m - before.z) / (p.z - before.z)) * (p - before);
      cut.z = -near_m;
      visit(cut);
    }
    before = p;
  }
}

}  // namespace gloam::test
