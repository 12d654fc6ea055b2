// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/pixel_surface.h"

namespace gloam {

PixelSurface pixel_surface(const GeometryPicture& geometry, std::uint32_t x, std::uint32_t y) {
  PixelSurface surface;
  const std::size_t at = std::size_t{y} * geometry.view.width + x;
  if (geometry.is_sky(at)) return surface;
  const GeometryTexel texel = geometry.texel(at);
  surface.exists = true;
  surface.position = geometry.position(x, y);
  surface.normal = glm::normalize(dvec3(texel.normal));
  surface.face_normal = glm::normalize(dvec3(texel.face_normal));
  const mat4& view = geometry.view.view_from_relative;
  const bool orthographic = geometry.view.camera.orthographic;
  surface.to_eye = glm::normalize(orthographic ? dvec3(view[0][2], view[1][2], view[2][2]) : -surface.position);
  surface.base_color = dvec3(texel.base_color);
  surface.roughness = texel.roughness;
  surface.metallic = texel.metallic;
  surface.occlusion = texel.occlusion;
  surface.reflectivity = texel.reflectivity;
  return surface;
}

}  // namespace gloam
