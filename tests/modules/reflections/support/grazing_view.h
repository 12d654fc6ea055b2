// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <glm/ext/matrix_transform.hpp>

#include "tests/support/render_scene.h"

namespace gloam::test {

/// A camera with a long lens, low above a floor at y = 0, whose picture shows the foot of a pile of boxes and the floor
/// before it at one to three times an angle.
class GrazingView {
 public:
  static constexpr int kBands = 4;      ///< boxes in the pile
  static constexpr double kAway = 4.0;  ///< distance of the pile

  explicit GrazingView(double degrees) : angle_(glm::radians(degrees)), height_(kAway * std::tan(angle_)) {}

  [[nodiscard]] ViewSettings camera(std::uint32_t width = 96, std::uint32_t height = 64) const {
    // The pile's right edge is in the middle, beside the sky.
    ViewSettings view = look_at(dvec3(kHalf, height_, kAway), dvec3(kHalf, 0.0, 0.0), width, height);
    view.camera.fov_y = static_cast<float>(4.0 * angle_);
    return view;
  }
  /// The matrix of a box from −1 to 1. Reflected, the pile's lowest three boxes fill the picture's lower half; they are
  /// as high as the camera together.
  [[nodiscard]] dmat4 box(int band) const {
    const double part = height_ / (kBands - 1), high = band < kBands - 1 ? part : 1.0;
    const dmat4 placed = glm::translate(dmat4(1.0), dvec3(0.0, part * band + 0.5 * high, -kDepth));
    return glm::scale(placed, dvec3(kHalf, 0.5 * high, kDepth));
  }
  [[nodiscard]] static vec3 light(int band) {
    return vec3(band % 2 == 0 ? 2.0f : 0.1f, band == 1 ? 1.5f : 0.2f, band >= 2 ? 1.8f : 0.3f);
  }
  /// The part of the picture that shows this height of the pile's reflection.
  [[nodiscard]] double picture_share(double height_m) const { return 0.25 * height_m / height_; }

 private:
  static constexpr double kHalf = 0.6;
  static constexpr double kDepth = 0.2;
  double angle_;
  double height_;
};

}  // namespace gloam::test
