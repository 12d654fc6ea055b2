// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/reference/emissive_quad.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/vector_double2.hpp>

#include "engine/core/assert.h"

namespace gloam {
namespace {

/// Bilinear, clamped to the edge. u, v: 0 … 1 from the upper left corner.
dvec4 image_color(const EmissiveQuad& quad, double u, double v) {
  const auto texel = [&](double x, double y) {
    const auto column = static_cast<std::size_t>(std::clamp(x, 0.0, quad.width - 1.0));
    const auto row = static_cast<std::size_t>(std::clamp(y, 0.0, quad.height - 1.0));
    return dvec4(quad.rgba[row * quad.width + column]);
  };
  const double x = u * quad.width - 0.5, y = v * quad.height - 0.5;
  const double left = std::floor(x), top = std::floor(y);
  return glm::mix(glm::mix(texel(left, top), texel(left + 1.0, top), x - left),
                  glm::mix(texel(left, top + 1.0), texel(left + 1.0, top + 1.0), x - left), y - top);
}

}  // namespace

void find_layers(std::span<const EmissiveQuad> quads, const dvec3& origin, const dvec3& direction, double to_m,
                 std::vector<QuadLayer>& layers) {
  layers.clear();
  for (const EmissiveQuad& quad : quads) {
    GLOAM_ASSERT(quad.rgba.size() == std::size_t{quad.width} * quad.height, "a texel for each pixel of the image");
    if (quad.rgba.empty()) continue;
    const dvec3 front = glm::cross(quad.half_u, quad.half_v);
    const double facing = glm::dot(front, direction);
    if (!(facing < 0.0)) continue;
    const double distance = glm::dot(front, quad.center - origin) / facing;
    if (!(distance > 0.0) || !(distance < to_m)) continue;
    const dvec3 at = origin + distance * direction - quad.center;
    const double right = glm::dot(at, quad.half_u) / glm::dot(quad.half_u, quad.half_u);
    const double up = glm::dot(at, quad.half_v) / glm::dot(quad.half_v, quad.half_v);
    if (!(std::abs(right) <= 1.0) || !(std::abs(up) <= 1.0)) continue;
    const dvec4 color = image_color(quad, 0.5 + 0.5 * right, 0.5 - 0.5 * up);
    layers.push_back({distance, dvec3(color) * static_cast<double>(quad.radiance),
                      std::clamp(color.w * static_cast<double>(quad.opacity), 0.0, 1.0)});
  }
  std::stable_sort(layers.begin(), layers.end(),
                   [](const QuadLayer& a, const QuadLayer& b) { return a.distance_m < b.distance_m; });
}

}  // namespace gloam
