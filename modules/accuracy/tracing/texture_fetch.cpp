// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/accuracy/tracing/texture_fetch.h"

#include "engine/math/srgb.h"

namespace gloam {

TextureFetch::TextureFetch() {
  for (std::size_t i = 0; i < linear_of_srgb_.size(); ++i)
    linear_of_srgb_[i] = srgb_to_linear(static_cast<float>(i) / 255.0f);
}

vec4 TextureFetch::sample(const SceneAssets& assets, const TextureSlot& slot, vec2 uv) const {
  if (slot.texture >= assets.textures.size()) return vec4(1.0f);
  const Texture& texture = assets.textures[slot.texture];
  if (texture.image >= assets.images.size()) return vec4(1.0f);
  const Image& image = assets.images[texture.image];
  if (image.width == 0 || image.height == 0) return vec4(1.0f);
  const auto texel = [&](std::int64_t x, std::int64_t y) {
    const std::size_t at =
        wrapped_texel(y, image.height, texture.wrap_v) * image.width + wrapped_texel(x, image.width, texture.wrap_u);
    const std::uint8_t* rgba = &image.rgba[4 * at];
    vec4 value(0.0f, 0.0f, 0.0f, static_cast<float>(rgba[3]) / 255.0f);
    for (int c = 0; c < 3; ++c)
      value[c] = texture.srgb ? linear_of_srgb_[rgba[c]] : static_cast<float>(rgba[c]) / 255.0f;
    return value;
  };
  const double shift = texture.nearest ? 0.0 : 0.5;
  const double x = texel_coordinate(uv.x, image.width) - shift, y = texel_coordinate(uv.y, image.height) - shift;
  const double left = std::floor(x), top = std::floor(y);
  const auto column = static_cast<std::int64_t>(left), row = static_cast<std::int64_t>(top);
  if (texture.nearest) return texel(column, row);
  const auto across = static_cast<float>(x - left), down = static_cast<float>(y - top);
  return glm::mix(glm::mix(texel(column, row), texel(column + 1, row), across),
                  glm::mix(texel(column, row + 1), texel(column + 1, row + 1), across), down);
}

}  // namespace gloam
