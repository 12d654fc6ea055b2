// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/shadows/views/receiver_depths.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "engine/math/finite.h"

namespace gloam {
namespace {

/// A point's clip-space x, y and w; w is its view depth.
using Point = dvec3;
constexpr std::size_t kPlanes = 5;
constexpr std::size_t kMostVertices = 4 + kPlanes;  // each plane adds at most one vertex to a convex polygon

/// Signed distances from the sides of the frustum and from the near plane, ≥ 0 inside.
std::array<double, kPlanes> distances(const Point& p, double near_m) {
  return {p.z + p.x, p.z - p.x, p.z + p.y, p.z - p.y, p.z - near_m};
}

struct Polygon {
  std::array<Point, kMostVertices> points;
  std::size_t count = 0;
};

Polygon clipped(const Polygon& from, std::size_t plane, double near_m) {
  Polygon to;
  for (std::size_t i = 0; i < from.count; ++i) {
    const Point &a = from.points[i], &b = from.points[(i + 1) % from.count];
    const double at_a = distances(a, near_m)[plane], at_b = distances(b, near_m)[plane];
    if (at_a >= 0.0 && to.count < kMostVertices) to.points[to.count++] = a;
    if ((at_a < 0.0) != (at_b < 0.0) && to.count < kMostVertices)
      to.points[to.count++] = glm::mix(a, b, at_a / (at_a - at_b));
  }
  return to;
}

/// The corners of a box: bit 0, 1, 2 of the number choose the high side along x, y, z.
std::array<Point, 8> corners_of(const RenderView& view, const dvec3& low, const dvec3& high) {
  const dmat4 clip(view.clip_from_relative);
  std::array<Point, 8> corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec3 at((i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z);
    const dvec4 p = clip * dvec4(at - view.position, 1.0);
    corners[i] = {p.x, p.y, p.w};
  }
  return corners;
}

constexpr std::array<std::array<std::size_t, 4>, 6> kSides = {
    {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};

}  // namespace

ReceiverDepths depths_in_view(const RenderView& view, const dvec3& low, const dvec3& high) {
  const double near_m = view.near_m;
  if (!is_finite(low) || !is_finite(high)) return {near_m, std::numeric_limits<double>::infinity()};
  const std::array<Point, 8> corners = corners_of(view, low, high);
  std::array<std::size_t, kPlanes> outside{};
  ReceiverDepths all;
  for (const Point& corner : corners) {
    const auto at = distances(corner, near_m);
    for (std::size_t plane = 0; plane < kPlanes; ++plane) outside[plane] += at[plane] < 0.0 ? 1 : 0;
    all.grow({corner.z, corner.z});
  }
  if (std::ranges::find(outside, corners.size()) != outside.end()) return {};
  // Margins for the rounding of float matrices.
  const auto widened = [&](const ReceiverDepths& range) {
    return ReceiverDepths{std::max(near_m, range.nearest * (1.0 - 1e-5)), range.farthest * (1.0 + 1e-5)};
  };
  if (std::ranges::all_of(outside, [](std::size_t count) { return count == 0; })) return widened(all);
  ReceiverDepths found;
  for (const auto& side : kSides) {
    Polygon polygon;
    for (const std::size_t corner : side) polygon.points[polygon.count++] = corners[corner];
    for (std::size_t plane = 0; plane < kPlanes && polygon.count > 0; ++plane)
      polygon = clipped(polygon, plane, near_m);
    for (std::size_t i = 0; i < polygon.count; ++i) found.grow({polygon.points[i].z, polygon.points[i].z});
  }
  // The near plane may begin inside the box.
  const dvec3 reach(2.0 * near_m / std::min(view.clip_from_view[0][0], view.clip_from_view[1][1]) + 2.0 * near_m);
  const bool inside = glm::all(glm::greaterThanEqual(view.position, low - reach)) &&
                      glm::all(glm::lessThanEqual(view.position, high + reach));
  if (inside) found.grow({near_m, std::max(near_m, found.farthest)});
  return found.any() ? widened(found) : ReceiverDepths{};
}

}  // namespace gloam
