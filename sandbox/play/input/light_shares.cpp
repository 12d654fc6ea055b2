// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "sandbox/play/input/light_shares.h"

#include <cstddef>

#include "engine/render/readback/geometry_picture.h"
#include "modules/lights/outputs.h"

namespace gloam {

Result<std::unordered_map<Entity, double>> light_shares(Session& session, ViewId view) {
  constexpr std::uint32_t kAcross = 48;
  constexpr std::uint32_t kDown = 27;
  const auto picture = session.renderer->read_geometry(session.world, view);
  if (!picture) return picture.error();
  std::unordered_map<Entity, double> sums;
  double whole = 0.0;
  for (std::uint32_t row = 0; row < kDown; ++row)
    for (std::uint32_t column = 0; column < kAcross; ++column) {
      const std::uint32_t x = (2 * column + 1) * picture->view.width / (2 * kAcross);
      const std::uint32_t y = (2 * row + 1) * picture->view.height / (2 * kDown);
      const std::size_t at = std::size_t{y} * picture->view.width + x;
      if (picture->is_sky(at)) continue;
      const GeometryTexel texel = picture->texel(at);
      const vec3 point(picture->position(x, y));
      const double albedo = glm::dot(dvec3(texel.base_color), dvec3(0.2126, 0.7152, 0.0722));
      for (const LightOnPoint& light : illuminance_at(session.world, view, point, texel.normal)) {
        sums[light.entity] += albedo * light.lux;
        whole += albedo * light.lux;
      }
    }
  if (whole > 0.0)
    for (auto& [light, sum] : sums) sum /= whole;
  return sums;
}

}  // namespace gloam
