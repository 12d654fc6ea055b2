// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/frustum.h"
#include "engine/math/types.h"

namespace gloam {

/// How a view maps world positions to pixels: all that the CPU systems of modules read of a view. RenderView is one;
/// hosts without a renderer make one with view_projection().
struct ViewProjection {
  std::uint32_t width = 0;  ///< pixels
  std::uint32_t height = 0;
  dvec3 position = dvec3(0.0);          ///< world position of the camera
  mat4 view_from_relative = mat4(1.0);  ///< rotation only; view space looks along −Z
  mat4 clip_from_view = mat4(1.0);      ///< reversed Z
  mat4 clip_from_relative = mat4(1.0);
  float near_m = 0.1f;
  Frustum frustum;  ///< in camera-relative space

  [[nodiscard]] bool orthographic() const { return clip_from_view[2][3] == 0.0f; }
  /// Camera-relative float position of a world position.
  [[nodiscard]] vec3 relative(const dvec3& world) const { return vec3(world - position); }
};

/// The projection of a camera. world_from_camera: rotation and translation; the camera looks along −Z. clip_from_view:
/// of reversed_perspective or reversed_orthographic with the same near_m, or with its centre moved. width, height > 0.
[[nodiscard]] ViewProjection view_projection(const dmat4& world_from_camera, const mat4& clip_from_view, float near_m,
                                             std::uint32_t width, std::uint32_t height);

}  // namespace gloam
