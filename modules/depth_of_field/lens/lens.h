// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "engine/ecs/world.h"
#include "engine/render/view.h"
#include "modules/depth_of_field/components.h"

namespace gloam {

/// Height of the sensor, metres.
inline constexpr double kSensorHeight_m = 0.024;

/// A thin lens that focuses on a plane, for one view. The signed radius of the circle of confusion in pixels of the
/// view, positive behind the focus, is offset + slope · depth, where depth is the value of the depth image.
struct Lens {
  double focus_m = 0.0;            ///< view depth of the plane of focus; may be infinite
  double aperture_radius_m = 0.0;  ///< of the lens, seen from the plane of focus; centred at the camera
  double offset_px = 0.0;
  double slope_px = 0.0;

  /// depth: of the depth image; 0 is the sky.
  [[nodiscard]] double radius_px(double depth) const { return offset_px + slope_px * depth; }
};

/// The lens of a view whose camera has these values; none if it never blurs anything by half a pixel.
///
/// Perspective: the focal length is f = 0.012 m / tan(yfov / 2). The circle on the sensor has the diameter
/// f² |z − s| / (N z (s − f)), with the focus s, the view depth z and the f-number N. A focus closer than the near
/// plane or than 1.01 f counts as that distance.
///
/// Orthographic: rays to the sensor are parallel, so a circle grows with its distance from the plane of focus on both
/// sides. The lens is that of a perspective camera which sees the same height at the focus: in the scene, a circle has
/// the diameter f |z − s| / (N s) with f = 0.012 m · s / half height. An infinite focus counts as 10⁶ m.
[[nodiscard]] std::optional<Lens> lens_of(const DepthOfField& values, const RenderView& view);

/// Whether these values blur anything at all.
[[nodiscard]] bool has_focus(const DepthOfField& values);

/// The values of the view's camera if it has a focus, else null.
[[nodiscard]] const DepthOfField* find_depth_of_field(const World& world, const RenderView& view);

}  // namespace gloam
