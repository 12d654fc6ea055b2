// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Screen range of a reflected proxy: P. Sikachev et al., Next-Generation Rendering in Thief, GPU Pro 6, section 1.2.4,
// algorithm 1.1. Changed, because the paper's range misses pixels near the near plane and at other heights than the
// floor's: the range is that of the volume below, clipped exactly.
//
// A receiver at p with an up normal turns the view ray d = p − eye into (d.x, −d.y, d.z). Mirrored at the plane y =
// p.y, the reflected ray continues the view ray. So if it hits the point q, the view ray meets q' = (q.x, 2h − q.y,
// q.z) beyond p, h = p.y. The pixel is therefore the projection of q', and q' is no nearer to the eye's plane than p.
//
// The pairs (q, h) with q on the proxy and lowest ≤ h ≤ min(highest, q.y, eye.y) form a convex polytope D: all
// conditions are linear. q' is linear in (q, h), so the set of all q' is the convex hull of the images of D's corners.
// Each corner of D is at h = lowest or h = min(highest, q.y, eye.y), over a corner of the proxy's outline, cut at y =
// lowest and split where the minimum changes, at y = min(highest, eye.y).
//
// A projection maps a convex set beyond the near plane to a convex set, so the extreme x of the part on the screen are
// at its corners. All pairs of points are cut instead of the hull's edges: they include the edges and stay inside the
// hull.
#include "modules/reflections/culling/reflected_quad.h"

#include <algorithm>
#include <cmath>

#include "engine/math/finite.h"

namespace gloam {
namespace {

using glm::dvec2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNearSlack = 1e-5;    // share of the near plane's distance
constexpr double kFacingSlack = 1e-7;  // sine of the angle between a ray and the proxy

/// Greatest height, relative to the eye, at which the viewer can see a receiver from above.
double highest_receiver(const ReceiverBand& band, const ReflectionViewer& viewer) {
  const double highest = band.highest_m - viewer.eye.y;
  return viewer.orthographic ? highest : std::min(highest, 0.0);
}

bool sees_receivers(const ReflectionViewer& viewer) { return !viewer.orthographic || viewer.forward.y < 0.0; }

/// A quad cut by one horizontal plane and split by another: at most 7 corners. The corners of a horizontal quad in one
/// of the planes are rounded to both of its sides, so each plane may cross all four edges: then there are at most 10.
struct Outline {
  static constexpr std::size_t kCapacity = ReflectedVolume::kCapacity / 2;
  std::array<dvec3, kCapacity> corners{};
  std::size_t count = 0;
  void add(const dvec3& corner) { corners[count++] = corner; }
};

/// The point of the segment at height y, which lies between the heights of a and b.
dvec3 at_height(const dvec3& a, const dvec3& b, double y) {
  dvec3 point = a + (b - a) * ((y - a.y) / (b.y - a.y));
  point.y = y;
  return point;
}

/// Adds corners where the outline crosses the plane y = height. Drops the part below if `cut` is set.
Outline split(const Outline& outline, double height, bool cut) {
  Outline result;
  for (std::size_t i = 0; i < outline.count; ++i) {
    const dvec3& a = outline.corners[i];
    const dvec3& b = outline.corners[(i + 1) % outline.count];
    if (!cut || a.y >= height) result.add(a);
    if ((a.y < height && b.y > height) || (a.y > height && b.y < height)) result.add(at_height(a, b, height));
  }
  return result;
}

/// Points in NDC of a volume clipped at the near plane. Of n points, k beyond the plane, k and k · (n − k) crossings
/// are kept.
struct ProjectedPoints {
  std::array<dvec2, ReflectedVolume::kCapacity / 2 * (ReflectedVolume::kCapacity / 2 + 1)> points;
  std::size_t count = 0;
  void add(const dvec4& clip) { points[count++] = dvec2(clip) / clip.w; }
};

/// clip.z is the view depth here, in metres.
ProjectedPoints project(std::span<const dvec3> points, const ReflectionViewer& viewer) {
  std::array<dvec4, ReflectedVolume::kCapacity> beyond;
  std::array<dvec4, ReflectedVolume::kCapacity> before;
  std::size_t beyond_count = 0;
  std::size_t before_count = 0;
  ProjectedPoints projected;
  for (const dvec3& point : points) {
    dvec4 clip = viewer.clip_from_relative * dvec4(point, 1.0);
    clip.z = glm::dot(point, viewer.forward);
    if (!(clip.z < viewer.near_m)) {  // NaN too, so that it reaches exact_screen_range
      projected.add(clip);
      beyond[beyond_count++] = clip;
    } else {
      before[before_count++] = clip;
    }
  }
  for (std::size_t i = 0; i < beyond_count; ++i)
    for (std::size_t j = 0; j < before_count; ++j)
      projected.add(glm::mix(before[j], beyond[i], (viewer.near_m - before[j].z) / (beyond[i].z - before[j].z)));
  return projected;
}

/// Grows the range to all points where segments between the points cross the line y = height.
void grow_to_crossings(std::span<const dvec2> points, double height, ScreenRange& range) {
  for (const dvec2& a : points) {
    if (!(a.y < height)) continue;
    for (const dvec2& b : points)
      if (b.y > height) range.grow(a.x + (b.x - a.x) * ((height - a.y) / (b.y - a.y)));
  }
}

}  // namespace

ReflectionViewer reflection_viewer(const ViewProjection& view) {
  ReflectionViewer viewer;
  viewer.eye = view.position;
  const mat4& m = view.view_from_relative;
  viewer.forward = -dvec3(m[0][2], m[1][2], m[2][2]);
  viewer.orthographic = view.orthographic();
  viewer.clip_from_relative = dmat4(view.clip_from_view) * dmat4(view.view_from_relative);
  const double near = view.near_m;
  viewer.near_m = near - kNearSlack * std::abs(near);
  viewer.row_margin = 4.0 / static_cast<double>(std::max(1u, view.height));
  return viewer;
}

ReflectedVolume reflected_volume(const PlacedProxy& proxy, const ReceiverBand& band, const ReflectionViewer& viewer) {
  ReflectedVolume volume;
  const double lowest = band.lowest_m - viewer.eye.y;
  const double highest = highest_receiver(band, viewer);
  if (!sees_receivers(viewer) || lowest > highest) return volume;
  Outline outline;
  for (const dvec3& corner : proxy.corners()) outline.add(corner - viewer.eye);
  outline = split(split(outline, lowest, true), highest, false);
  for (const dvec3& q : std::span(outline.corners).first(outline.count)) {
    volume.add({q.x, 2.0 * lowest - q.y, q.z});
    volume.add({q.x, q.y <= highest ? q.y : 2.0 * highest - q.y, q.z});
  }
  return volume;
}

bool may_face_viewer(const PlacedProxy& proxy, const ReceiverBand& band, const ReflectionViewer& viewer) {
  if (!sees_receivers(viewer)) return false;
  if (viewer.orthographic) {
    const dvec3 reflected(viewer.forward.x, -viewer.forward.y, viewer.forward.z);
    return glm::dot(proxy.normal, reflected) <= kFacingSlack;
  }
  const dvec3 center = proxy.center - viewer.eye;
  const double top = center.y + std::abs(proxy.half_u.y) + std::abs(proxy.half_v.y);
  const double lowest = band.lowest_m - viewer.eye.y;
  const double highest = std::min(highest_receiver(band, viewer), top);
  if (lowest > highest) return false;
  // The eye mirrored at y = h is (0, 2h, 0). The side of the proxy's plane that it lies on is linear in h.
  const auto faces = [&](double h) {
    const dvec3 from_center = dvec3(0.0, 2.0 * h, 0.0) - center;
    return !(glm::dot(proxy.normal, from_center) < -kFacingSlack * glm::length(from_center));
  };
  return faces(lowest) || faces(highest);
}

ScreenRange exact_screen_range(const ReflectedVolume& volume, const ReflectionViewer& viewer) {
  const ProjectedPoints projected = project(volume.all(), viewer);
  const std::span<const dvec2> points = std::span(projected.points).first(projected.count);
  ScreenRange range;
  const double border = 1.0 + viewer.row_margin;
  for (const dvec2& point : points) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) return {-kInfinity, kInfinity};
    if (std::abs(point.y) <= border) range.grow(point.x);
  }
  grow_to_crossings(points, -border, range);
  grow_to_crossings(points, border, range);
  return range;
}

ScreenRange paper_screen_range(const PlacedProxy& proxy, double height_m, const ReflectionViewer& viewer) {
  const dvec3 reach = glm::abs(proxy.half_u) + glm::abs(proxy.half_v);
  ScreenRange range;
  for (int column = 0; column < 4; ++column) {
    dvec2 ends[2];
    for (int end = 0; end < 2; ++end) {
      dvec3 corner =
          proxy.center + reach * dvec3(column & 1 ? 1.0 : -1.0, end == 1 ? 1.0 : -1.0, column & 2 ? 1.0 : -1.0);
      corner.y = 2.0 * height_m - corner.y;
      const dvec4 clip = viewer.clip_from_relative * dvec4(corner - viewer.eye, 1.0);
      ends[end] = dvec2(clip) / std::max(std::abs(clip.w), 1e-30);
      range.grow(ends[end].x);
    }
    if (ends[0].y == ends[1].y) continue;
    for (const double border : {-1.0, 1.0})
      range.grow(ends[0].x + (ends[1].x - ends[0].x) * ((border - ends[0].y) / (ends[1].y - ends[0].y)));
  }
  return range;
}

}  // namespace gloam
