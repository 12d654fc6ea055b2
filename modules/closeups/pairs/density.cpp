// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/closeups/pairs/density.h"

#include <algorithm>
#include <cmath>

#include "engine/render/camera/view_constants.h"

namespace gloam {
namespace {

constexpr double kEdgeOn = 1e-4;  // lower limit of the sine between surface and view ray

dvec3 in_face(const ShadowFace& face, const dvec3& v) {
  return {glm::dot(dvec3(face.right), v), glm::dot(dvec3(face.up), v), glm::dot(dvec3(face.forward), v)};
}

}  // namespace

PixelFootprint pixel_footprint(const RenderView& view, std::uint32_t x, std::uint32_t y, float depth,
                               const dvec3& normal) {
  const shaders::ViewConstants c = view_constants(view);
  const bool orthographic = view.camera.orthographic;
  const double scale = orthographic ? 1.0 : static_cast<double>(c.ray_base.w) / static_cast<double>(depth);
  const dvec3 dx = dvec3(c.ray_dx) * scale, dy = dvec3(c.ray_dy) * scale, forward(c.ray_forward);
  PixelFootprint footprint;
  footprint.position = dvec3(c.ray_base) * scale + dx * static_cast<double>(x) + dy * static_cast<double>(y) +
                       forward * static_cast<double>(c.ray_dx.w + depth * c.ray_dy.w);
  const dvec3 along = orthographic ? forward : footprint.position;
  const double least = kEdgeOn * glm::length(along);
  double facing = glm::dot(normal, along);
  if (std::abs(facing) < least) facing = facing < 0.0 ? -least : least;
  footprint.right = dx - along * (glm::dot(normal, dx) / facing);
  footprint.down = dy - along * (glm::dot(normal, dy) / facing);
  return footprint;
}

std::optional<double> texels_per_pixel(const ShadowFace& face, const RenderView& view,
                                       const PixelFootprint& footprint) {
  const dvec3 at = in_face(face, footprint.position + view.position - face.origin);
  const bool perspective = face.tan_half > 0.0f;
  const double half = perspective ? at.z * face.tan_half : static_cast<double>(face.half_extent_m);
  if (at.z < face.near_m || at.z > face.far_m || std::max(std::abs(at.x), std::abs(at.y)) > half) return std::nullopt;
  const glm::dvec2 tangent = perspective ? glm::dvec2(at) / at.z : glm::dvec2(0.0);
  const dvec3 right = in_face(face, footprint.right), down = in_face(face, footprint.down);
  const glm::dvec2 u = glm::dvec2(right) - tangent * right.z, v = glm::dvec2(down) - tangent * down.z;
  return 0.5 * face.square.size / half * std::sqrt(std::abs(u.x * v.y - u.y * v.x));
}

}  // namespace gloam
