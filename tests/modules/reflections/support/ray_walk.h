// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "tests/modules/reflections/support/synthetic_view.h"

namespace gloam::test {

/// A place where a ray passes behind the depth image. The image is taken as steps: a surface at one depth per pixel.
struct Passing {
  double along_m = 0.0;   ///< distance where it begins
  double behind_m = 0.0;  ///< how far the ray is behind the surface there: 0 unless it comes from beside the surface
  double pixels = 0.0;    ///< length on the screen over which the ray stays behind by less than the thickness
  uvec2 pixel = uvec2(0u);
};

/// Follows the ray of a pixel through the depth image, pixel by pixel, in double.
class RayWalk {
 public:
  RayWalk(const SyntheticView& seen, const shaders::ReflectionConstants& c, uvec2 pixel)
      : seen_(seen),
        origin_(seen.position(pixel.x, pixel.y)),
        direction_(seen.mirrored(pixel.x, pixel.y)),
        thickness_m_(c.thickness_m),
        reach_m_(static_cast<double>(c.reach_m) / direction_.y) {}

  [[nodiscard]] dvec3 at(double along_m) const { return origin_ + direction_ * along_m; }
  [[nodiscard]] dvec3 direction() const { return direction_; }
  /// Continuous pixel coordinates.
  [[nodiscard]] dvec2 on_screen(const dvec3& relative) const {
    const dvec2 ndc = ndc_of(seen_.view, relative);
    return {(0.5 + 0.5 * ndc.x) * seen_.view.width, (0.5 - 0.5 * ndc.y) * seen_.view.height};
  }
  [[nodiscard]] double depth_m(const dvec3& relative) const {
    return -(dmat4(seen_.view.view_from_relative) * dvec4(relative, 1.0)).z;
  }
  [[nodiscard]] double behind_m(double along_m, uvec2 pixel) const {
    if (seen_.object[seen_.at(pixel.x, pixel.y)] < 0) return -1.0;
    return depth_m(at(along_m)) - seen_.view_depth(seen_.at(pixel.x, pixel.y));
  }
  /// All passings up to the reach, the screen's border and the near plane, nearest first.
  [[nodiscard]] std::vector<Passing> passings() const {
    std::vector<Passing> found;
    const double end = last_on_screen();
    // Steps of a tenth of a pixel; crossings are refined by bisection.
    const double length_px = screen_length(end);
    const auto count = static_cast<std::uint32_t>(std::clamp(10.0 * length_px, 64.0, 8192.0));
    double before = 0.0;
    bool was_behind = true;  // the ray begins on its surface
    for (std::uint32_t i = 1; i < count; ++i) {
      const double s = static_cast<double>(i) / count, now = place(end, s);
      const uvec2 pixel = pixel_at(now);
      const double behind = behind_m(now, pixel);
      const bool is_behind = behind > 1e-9 && seen_.object[seen_.at(pixel.x, pixel.y)] != 0;
      if (is_behind && !was_behind) found.push_back({now, first_behind(before, now, pixel), 0.0, pixel});
      if (is_behind && behind < thickness_m_ && !found.empty()) found.back().pixels += length_px / count;
      was_behind = is_behind;
      before = now;
    }
    return found;
  }
  [[nodiscard]] uvec2 pixel_at(double along_m) const {
    const dvec2 p = on_screen(at(along_m));
    return {std::min(static_cast<std::uint32_t>(std::max(p.x, 0.0)), seen_.view.width - 1),
            std::min(static_cast<std::uint32_t>(std::max(p.y, 0.0)), seen_.view.height - 1)};
  }

  /// Distance at which the ray ends: at its reach, the border of the screen or the near plane.
  [[nodiscard]] double last_on_screen() const {
    double inside = 0.0, outside = reach_m_;
    if (visible(outside)) return outside;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (inside + outside);
      (visible(middle) ? inside : outside) = middle;
    }
    return inside;
  }

 private:
  /// Distance at a share of the way on the screen to the point at `end`.
  [[nodiscard]] double place(double end, double s) const {
    const double a = depth_m(at(0.0)), b = depth_m(at(end));
    return seen_.view.camera.orthographic ? end * s : end * (s * a / (b + (a - b) * s));
  }
  [[nodiscard]] double screen_length(double end) const {
    const dvec2 way = on_screen(at(end)) - on_screen(at(0.0));
    return std::max(std::abs(way.x), std::abs(way.y));
  }
  [[nodiscard]] bool visible(double along_m) const {
    const dvec3 p = at(along_m);
    if (depth_m(p) <= static_cast<double>(seen_.view.near_m)) return false;
    const dvec2 s = on_screen(p);
    return s.x >= 0.0 && s.y >= 0.0 && s.x <= seen_.view.width && s.y <= seen_.view.height;
  }
  /// How far the ray is behind where it enters the pixel's surface: 0 if it crosses within the pixel.
  [[nodiscard]] double first_behind(double before, double now, uvec2 pixel) const {
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (before + now);
      if (pixel_at(middle) == pixel && behind_m(middle, pixel) > 0.0)
        now = middle;
      else
        before = middle;
    }
    return behind_m(now, pixel);
  }

  const SyntheticView& seen_;
  dvec3 origin_, direction_;
  double thickness_m_, reach_m_;
};

}  // namespace gloam::test
