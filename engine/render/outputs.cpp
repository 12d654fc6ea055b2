// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "engine/render/outputs.h"

#include "engine/math/packing.h"

namespace gloam {
namespace {

float channel(std::uint32_t packed, unsigned index) {
  return static_cast<float>(packed >> (8 * index) & 0xFFu) / 255.0f;
}

}  // namespace

GeometryTexel decode_geometry(std::uint32_t base_color, glm::uvec2 normals, std::uint32_t material) {
  GeometryTexel texel;
  for (unsigned c = 0; c < 3; ++c)
    texel.base_color[static_cast<int>(c)] = channel(base_color, c) * channel(base_color, c);
  texel.subsurface = channel(base_color, 3) > 0.5f;
  texel.normal = unpack_normal_snorm16(normals.x);
  texel.face_normal = unpack_normal_snorm16(normals.y);
  texel.roughness = channel(material, 0);
  texel.metallic = channel(material, 1);
  texel.occlusion = channel(material, 2);
  texel.reflectivity = channel(material, 3);
  return texel;
}

SmoothSurface decode_smooth_surface(uvec2 texel) {
  if (texel.y == 0) return {};
  const auto coordinate = [&](unsigned byte) {
    return (static_cast<float>(texel.y >> (8 * byte) & 0xFFu) - 128.0f) / 127.0f;
  };
  return {.exists = true,
          .offset = octahedral_decode(vec2(coordinate(0), coordinate(1))) *
                    half_to_float(static_cast<std::uint16_t>(texel.y >> 16)),
          .normal = unpack_normal_snorm16(texel.x)};
}

}  // namespace gloam
