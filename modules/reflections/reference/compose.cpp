// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include <algorithm>

#include "engine/core/assert.h"
#include "engine/render/camera/light_scale.h"
#include "engine/scene/resources.h"
#include "modules/reflections/reference/pixel_surface.h"
#include "modules/reflections/reference/reflection_tracing.h"
#include "modules/reflections/reference/shading.h"

namespace gloam {
namespace {

/// Adds light to each pixel with a surface. added: the light of a surface and its pixel.
template <class Added>
LinearPicture with_added_light(const LinearPicture& picture, const GeometryPicture& geometry, const Added& added) {
  GLOAM_ASSERT(picture.width == geometry.view.width && picture.height == geometry.view.height,
               "picture and geometry have the same size");
  LinearPicture result = picture;
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const PixelSurface surface = pixel_surface(geometry, x, y);
      if (!surface.exists) continue;
      const std::size_t pixel = std::size_t{y} * picture.width + x;
      const dvec3 light = added(surface, pixel);
      for (int c = 0; c < 3; ++c) {
        const double sum = static_cast<double>(picture.rgba[4 * pixel + static_cast<std::size_t>(c)]) + light[c];
        result.rgba[4 * pixel + static_cast<std::size_t>(c)] =
            static_cast<float>(std::clamp(sum, 0.0, kMostHalf / geometry.view.light_scale));
      }
    }
  return result;
}

}  // namespace

LinearPicture compose_reflections(const LinearPicture& base, const GeometryPicture& geometry, const World& world,
                                  const TracedReflections& traced) {
  GLOAM_ASSERT(base.width == traced.width && base.height == traced.height, "pictures of the same size");
  const auto& sky = world.resource<SceneEnvironment>();
  return with_added_light(base, geometry, [&](const PixelSurface& surface, std::size_t pixel) {
    const TwinPoint p = surface.twin();
    const float* const texel = &traced.radiance[4 * pixel];
    const dvec3 reflected(texel[0], texel[1], texel[2]);
    const double reflectivity = texel[3] > 0.0f ? surface.reflectivity : 0.0;
    return surface.occlusion * specular_share(p) * glm::mix(mirrored_radiance(sky, p), reflected, reflectivity);
  });
}

LinearPicture without_specular_ambient(const LinearPicture& lit, const GeometryPicture& geometry, const World& world) {
  const auto& sky = world.resource<SceneEnvironment>();
  return with_added_light(lit, geometry, [&](const PixelSurface& surface, std::size_t) {
    const TwinPoint p = surface.twin();
    return -surface.occlusion * specular_share(p) * mirrored_radiance(sky, p);
  });
}

}  // namespace gloam
