// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <random>

#include "modules/closeups/pairs/frustum.h"
#include "modules/shadows/views/faces.h"

namespace gloam::test {

/// A pair's face and a standard face of the same light.
struct TransferCase {
  ShadowFace from;
  ShadowFace to;
};

class TransferDice {
 public:
  explicit TransferDice(std::uint32_t seed) : random_(seed) {}

  [[nodiscard]] TransferCase pair(bool perspective) {
    TransferCase made;
    const dvec3 origin(between(-50.0, 50.0), between(-50.0, 50.0), between(-50.0, 50.0));
    for (ShadowFace* face : {&made.from, &made.to}) {
      face->origin = origin;
      face->kind = perspective ? LightKind::spot : LightKind::directional;
    }
    made.from.square = {uvec2(256, 0), 64u << random_() % 3};
    made.to.square = {uvec2(0), 16u << random_() % 4};
    if (perspective) {
      set_perspective(made);
    } else {
      set_orthographic(made);
    }
    return made;
  }
  /// A random point inside a face's frustum.
  [[nodiscard]] dvec3 seen_by(const ShadowFace& face) {
    const double side = face.square.size, far = face.far_m, near = face.near_m;
    return unproject(face, between(0.0, side), between(0.0, side), between(near, near + 0.5 * (far - near)));
  }
  [[nodiscard]] double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  [[nodiscard]] std::uint32_t word() { return static_cast<std::uint32_t>(random_()); }

 private:
  void set_axes(ShadowFace& face, const CloseupAxes& axes) const {
    face.right = axes.right;
    face.up = axes.up;
    face.forward = axes.forward;
  }
  void set_perspective(TransferCase& made) {
    const FaceAxes cube = cube_axes(word() % 6);
    set_axes(made.to, {cube.right, cube.up, cube.forward});
    made.to.tan_half = 1.125f;
    made.to.near_m = 0.02886f;
    made.to.far_m = 10.0f;
    const dvec3 ahead =
        dvec3(made.to.forward) + dvec3(made.to.right) * between(-0.7, 0.7) + dvec3(made.to.up) * between(-0.7, 0.7);
    set_axes(made.from, closeup_axes(glm::normalize(ahead)));
    made.from.tan_half = static_cast<float>(between(0.05, 0.4));
    made.from.near_m = static_cast<float>(between(0.5, 2.0));
    made.from.far_m = 10.0f;
  }
  void set_orthographic(TransferCase& made) {
    const dvec3 ahead = glm::normalize(dvec3(between(-1.0, 1.0), -1.0, between(-1.0, 1.0)));
    const CloseupAxes axes = closeup_axes(ahead);
    set_axes(made.from, axes);
    // The same direction, rotated about it.
    const double turn = between(-3.0, 3.0), c = std::cos(turn), s = std::sin(turn);
    const dvec3 right = dvec3(axes.right) * c + dvec3(axes.up) * s;
    set_axes(made.to, {vec3(right), vec3(glm::cross(right, dvec3(axes.forward))), axes.forward});
    made.to.tan_half = made.from.tan_half = 0.0f;
    made.to.near_m = made.from.near_m = 0.0f;
    made.to.half_extent_m = static_cast<float>(between(3.0, 10.0));
    made.to.far_m = 30.0f;
    made.from.half_extent_m = static_cast<float>(between(0.3, 1.0));
    made.from.far_m = static_cast<float>(between(1.0, 8.0));
    made.from.origin +=
        ahead * between(3.0, 10.0) + dvec3(axes.right) * between(-1.0, 1.0) + dvec3(axes.up) * between(-1.0, 1.0);
  }

  std::mt19937 random_;
};

}  // namespace gloam::test
