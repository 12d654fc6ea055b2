// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"
#include "engine/render/readback/geometry_picture.h"
#include "modules/reflections/reference/shading.h"

namespace gloam {

/// The surface at a pixel, as the geometry buffer holds it.
struct PixelSurface {
  bool exists = false;             ///< false: sky; nothing else is set then
  dvec3 position = dvec3(0.0);     ///< camera-relative
  dvec3 normal = dvec3(0.0);       ///< unit
  dvec3 face_normal = dvec3(0.0);  ///< unit, toward the viewer
  dvec3 to_eye = dvec3(0.0);       ///< unit
  dvec3 base_color = dvec3(0.0);
  double roughness = 1.0;
  double metallic = 0.0;
  double occlusion = 1.0;
  double reflectivity = 0.0;

  [[nodiscard]] TwinPoint twin() const { return twin_point(to_eye, normal, base_color, metallic, roughness); }
};

[[nodiscard]] PixelSurface pixel_surface(const GeometryPicture& geometry, std::uint32_t x, std::uint32_t y);

}  // namespace gloam
