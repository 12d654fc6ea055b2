// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/reflections/bake/proxy_texture.h"

#include <algorithm>
#include <array>

#include "engine/math/srgb.h"
#include "engine/scene/decoding/image_file.h"

namespace gloam {

Result<CapturedPicture> read_proxy_texture(const std::string& path, std::uint32_t side) {
  const auto image = read_image_file(path);
  if (!image.ok()) return Error{ErrorKind::input, "gloam.ibr_proxy.texture: " + path + ": " + image.error().message};
  std::array<float, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
  CapturedPicture picture{image->width, image->height, {}};
  picture.texels.reserve(image->rgba.size() / 4);
  for (std::size_t i = 0; i + 4 <= image->rgba.size(); i += 4) {
    const std::uint8_t* const rgba = &image->rgba[i];
    const float alpha = static_cast<float>(rgba[3]) / 255.0f;
    picture.texels.emplace_back(alpha * vec3(linear[rgba[0]], linear[rgba[1]], linear[rgba[2]]), alpha);
  }
  return resampled(picture, side);
}

void scale_to_lights(CapturedPicture& picture, double area_m2, std::span<const LightSource> lights,
                     std::span<const CapturedProxyLight> chosen, float light_scale) {
  double candela = 0.0;
  for (const LightSource& source : lights)
    if (source.light.kind != LightKind::directional &&
        std::ranges::find(chosen, source.entity, &CapturedProxyLight::light) != chosen.end())
      candela += luminance_of(dvec3(source.emitted()));
  double mean = 0.0;
  for (const vec4& texel : picture.texels)
    mean += luminance_of(dvec3(texel)) / static_cast<double>(picture.texels.size());
  if (!(mean > 0.0) || !(area_m2 > 0.0)) return;
  const auto scale = static_cast<float>(static_cast<double>(light_scale) * candela / (area_m2 * mean));
  for (vec4& texel : picture.texels) texel = vec4(storable(vec3(texel) * scale), texel.w);
}

}  // namespace gloam
