// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "engine/math/types.h"
#include "engine/math/view_projection.h"
#include "modules/reflections/culling/placed.h"
#include "modules/reflections/culling/rooms.h"

namespace gloam {

/// A view in double, as the functions below read it.
struct ReflectionViewer {
  dvec3 eye = dvec3(0.0);                 ///< world
  dvec3 forward = dvec3(0.0, 0.0, -1.0);  ///< world, unit length; direction of all orthographic view rays
  bool orthographic = false;
  dmat4 clip_from_relative = dmat4(1.0);
  double near_m = 0.1;      ///< a little nearer than the view's near plane, so that rounding loses no receiver
  double row_margin = 0.0;  ///< NDC height added at the top and bottom of the screen: two pixels
};
[[nodiscard]] ReflectionViewer reflection_viewer(const ViewProjection& view);

/// Interval of NDC x; empty if min > max. It may reach beyond −1…1.
struct ScreenRange {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  [[nodiscard]] bool empty() const { return !(min <= max); }
  void grow(double x) {
    min = x < min ? x : min;
    max = x > max ? x : max;
  }
};

/// Points relative to the eye. Their convex hull is the reflected volume of a proxy.
struct ReflectedVolume {
  static constexpr std::size_t kCapacity = 20;
  std::array<dvec3, kCapacity> points{};
  std::size_t count = 0;
  void add(const dvec3& point) { points[count++] = point; }
  [[nodiscard]] std::span<const dvec3> all() const { return std::span(points).first(count); }
};

/// The reflected volume: all mirror images of the proxy that receivers with an up normal may show to the viewer. A
/// receiver at height h shows the point q of the proxy where the view ray meets q mirrored at the plane y = h, if h is
/// in the band, not above q, and not above the eye. Empty if no receiver can show the proxy. Only view rays that
/// descend count: the underside of a surface reflects nothing.
[[nodiscard]] ReflectedVolume reflected_volume(const PlacedProxy& proxy, const ReceiverBand& band,
                                               const ReflectionViewer& viewer);

/// Whether a reflected ray of some receiver of the band may meet the front of the proxy. Conservative: rays parallel to
/// the proxy count as meeting its front.
[[nodiscard]] bool may_face_viewer(const PlacedProxy& proxy, const ReceiverBand& band, const ReflectionViewer& viewer);

/// Range of NDC x over the part of the volume beyond the near plane and between the top and bottom of the screen: exact
/// up to ReflectionViewer's margins. Values that overflow give the whole screen.
[[nodiscard]] ScreenRange exact_screen_range(const ReflectedVolume& volume, const ReflectionViewer& viewer);

/// Range of NDC x by algorithm 1.1 of the paper: the proxy's box, mirrored at the plane y = height_m, with |w| in place
/// of a clip at the near plane, and its vertical edges extended to the top and bottom of the screen. Not conservative:
/// for comparison.
[[nodiscard]] ScreenRange paper_screen_range(const PlacedProxy& proxy, double height_m, const ReflectionViewer& viewer);

}  // namespace gloam
