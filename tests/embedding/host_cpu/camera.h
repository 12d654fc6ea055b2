// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"
#include "engine/math/view_projection.h"

namespace host {

using gloam::dmat4;
using gloam::dvec3;

/// A perspective camera in double precision, from which the checks of this host compute pixels and rays.
struct HostCamera {
  std::uint32_t width = 320;
  std::uint32_t height = 180;
  double fov_y = 1.1;
  double near_m = 0.1;
  dmat4 world_from_camera = dmat4(1.0);  ///< rotation and translation

  [[nodiscard]] gloam::ViewProjection projection() const;
  /// World direction of the ray through a point of the image, with length 1 along the camera's axis.
  [[nodiscard]] dvec3 ray(double x, double y) const;
  [[nodiscard]] dvec3 position() const { return dvec3(world_from_camera[3]); }
};

/// A camera at `from` that looks at `to`.
[[nodiscard]] HostCamera looking_at(const dvec3& from, const dvec3& to);

}  // namespace host
