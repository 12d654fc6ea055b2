// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/depth_of_field/lens/lens.h"

#include <algorithm>
#include <cmath>

namespace gloam {
namespace {

constexpr double kFarthestFocus_m = 1e6;  // of an orthographic camera, metres
constexpr double kNearestFocus = 1.01;    // focal lengths
constexpr double kLeastRadius_px = 0.5;   // smaller circles are in focus (kInFocus, coc_api.glsl)
constexpr double kGreatest_px = 1e9;      // keeps sums finite

double bounded(double value) { return std::clamp(value, -kGreatest_px, kGreatest_px); }

/// Focal length, in units, of a perspective camera, and of an orthographic one for each metre of its focus. lens_scale:
/// clip_from_view[1][1].
double focal_length(double lens_scale, double unit_m) { return 0.5 * kSensorHeight_m / unit_m * lens_scale; }

Lens perspective_lens(const dmat4& clip, double focus_m, double f_number, double pixels, double unit_m) {
  const double focal_m = focal_length(clip[1][1], unit_m);
  Lens lens;
  lens.focus_m = std::max(focus_m, kNearestFocus * focal_m);
  const double widened = std::isinf(lens.focus_m) ? 1.0 : lens.focus_m / (lens.focus_m - focal_m);
  lens.aperture_radius_m = 0.5 * focal_m / f_number * widened;
  // radius = scale (1/s − 1/z), and 1/z = (clip22 − depth · clip23) / clip32.
  const double scale = lens.aperture_radius_m * clip[1][1] * pixels;
  lens.offset_px = bounded(scale * (1.0 / lens.focus_m - clip[2][2] / clip[3][2]));
  lens.slope_px = bounded(scale * clip[2][3] / clip[3][2]);
  return lens;
}

Lens orthographic_lens(const dmat4& clip, double focus_m, double f_number, double pixels, double unit_m) {
  Lens lens;
  lens.focus_m = std::min(focus_m, kFarthestFocus_m / unit_m);
  lens.aperture_radius_m = 0.5 * kSensorHeight_m * clip[1][1] * 0.5 * lens.focus_m / f_number;
  // radius = scale (z/s − 1), and z = (clip32 − depth) / clip22.
  const double scale = lens.aperture_radius_m * clip[1][1] * pixels;
  lens.offset_px = bounded(scale * (clip[3][2] / (clip[2][2] * lens.focus_m) - 1.0));
  lens.slope_px = bounded(-scale / (clip[2][2] * lens.focus_m));
  return lens;
}

}  // namespace

bool has_focus(const DepthOfField& values) {
  return values.focus_m > 0.0f && values.f_number >= 0.0f && !std::isinf(values.f_number);
}

std::optional<Lens> lens_of(const DepthOfField& values, const RenderView& view) {
  if (!has_focus(values)) return std::nullopt;
  const dmat4 clip(view.clip_from_view);
  const double f_number = std::max(values.f_number, kLeastFNumber);
  const double focus_m = std::max(values.focus_m, view.near_m);
  const double pixels = 0.5 * view.height;
  const double unit_m = values.metres_per_unit > 0.0f ? static_cast<double>(values.metres_per_unit) : 1.0;
  const Lens lens = view.camera.orthographic ? orthographic_lens(clip, focus_m, f_number, pixels, unit_m)
                                             : perspective_lens(clip, focus_m, f_number, pixels, unit_m);
  const double widest = std::max(std::abs(lens.radius_px(0.0)), std::abs(lens.radius_px(1.0)));
  if (widest < kLeastRadius_px) return std::nullopt;
  return lens;
}

const DepthOfField* find_depth_of_field(const World& world, const RenderView& view) {
  const DepthOfField* values =
      view.camera_entity == kNoEntity ? nullptr : world.try_get<DepthOfField>(view.camera_entity);
  return values != nullptr && has_focus(*values) ? values : nullptr;
}

}  // namespace gloam
