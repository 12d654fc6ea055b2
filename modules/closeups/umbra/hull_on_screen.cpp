// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/umbra/hull_on_screen.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace gloam {
namespace {

using glm::dvec2;

const ScreenRect kNowhere{dvec2(std::numeric_limits<double>::infinity()),
                          dvec2(-std::numeric_limits<double>::infinity())};

/// Projected points whose hull is the projection of the points' hull, clipped at the near plane.
std::vector<dvec2> projected(std::span<const dvec3> points, const ViewProjection& view) {
  const dmat4 clip(view.clip_from_view);
  const double near = view.near_m;
  std::vector<dvec2> seen;
  std::vector<dvec3> behind;
  std::vector<dvec3> before;
  const auto add = [&](const dvec3& p) {
    const dvec4 at = clip * dvec4(p, 1.0);
    seen.push_back(dvec2(at) / at.w);
  };
  for (const dvec3& p : points) {
    if (-p.z < near) {
      behind.push_back(p);
      continue;
    }
    before.push_back(p);
    add(p);
  }
  // The points where edges of the hull, and other segments inside it, cross the near plane.
  for (const dvec3& a : behind) {
    for (const dvec3& b : before) {
      const double share = (near + a.z) / (a.z - b.z);
      const dvec3 at = a + (b - a) * share;
      add(dvec3(at.x, at.y, -near));
    }
  }
  return seen;
}

double turn(const dvec2& a, const dvec2& b, const dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Andrew's monotone chain. Drops points on an edge and duplicates.
std::vector<dvec2> convex_hull(std::vector<dvec2> points) {
  std::ranges::sort(points, [](const dvec2& a, const dvec2& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  if (points.size() < 3) return points;
  std::vector<dvec2> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t first = hull.size();
    for (const dvec2& p : points) {
      while (hull.size() >= first + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0.0) hull.pop_back();
      hull.push_back(p);
    }
    if (hull.size() > first + 1) hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

/// The part of a convex polygon with sign · p[axis] ≤ sign · bound.
std::vector<dvec2> cut(const std::vector<dvec2>& polygon, int axis, double sign, double bound) {
  std::vector<dvec2> kept;
  const auto over = [&](const dvec2& p) { return sign * (p[axis] - bound); };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec2& a = polygon[i];
    const dvec2& b = polygon[(i + 1) % polygon.size()];
    const double over_a = over(a);
    const double over_b = over(b);
    if (over_a <= 0.0) kept.push_back(a);
    if ((over_a < 0.0 && over_b > 0.0) || (over_a > 0.0 && over_b < 0.0)) {
      dvec2 at = a + (b - a) * (over_a / (over_a - over_b));
      at[axis] = bound;
      kept.push_back(at);
    }
  }
  return kept;
}

ScreenRect bounds_of(std::span<const dvec2> points) {
  ScreenRect rect = kNowhere;
  for (const dvec2& p : points) {
    rect.low = glm::min(rect.low, p);
    rect.high = glm::max(rect.high, p);
  }
  return rect;
}

}  // namespace

ScreenRect hull_on_screen(std::span<const dvec3> points, const ViewProjection& view, const ScreenRect& limit) {
  if (limit.empty()) return kNowhere;
  std::vector<dvec2> seen = projected(points, view);
  const ScreenRect all = bounds_of(seen);
  const bool inside =
      all.low.x >= limit.low.x && all.low.y >= limit.low.y && all.high.x <= limit.high.x && all.high.y <= limit.high.y;
  if (seen.empty() || inside) return all;
  std::vector<dvec2> polygon = convex_hull(std::move(seen));
  for (int axis = 0; axis < 2; ++axis) {
    polygon = cut(polygon, axis, 1.0, limit.high[axis]);
    polygon = cut(polygon, axis, -1.0, limit.low[axis]);
  }
  return bounds_of(polygon);
}

}  // namespace gloam
