// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/grass/drawing/blade_images.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <string>

#include "engine/math/srgb.h"

namespace gloam {
namespace {

std::uint8_t byte_of(float unit) { return static_cast<std::uint8_t>(std::clamp(unit, 0.0f, 1.0f) * 255.0f + 0.5f); }

/// A texel of a line and its weight in one texel of the line of another length. The weights of such a texel sum to 1.
struct Weight {
  std::uint32_t from = 0;
  float share = 0.0f;
};

/// Fewer texels are means of what they cover, more are interpolated.
std::vector<Weight> weights_of(std::uint32_t target, std::uint32_t size, std::uint32_t source_size) {
  const double scale = static_cast<double>(source_size) / size;
  const double from = target * scale, to = (target + 1) * scale, middle = 0.5 * (from + to) - 0.5;
  const std::uint32_t last = source_size - 1;
  if (scale < 1.0) {
    const double whole = std::floor(middle);
    const auto share = static_cast<float>(middle - whole);
    const auto first = static_cast<std::uint32_t>(std::max(whole, 0.0));
    return {{first, 1.0f - share}, {std::min(static_cast<std::uint32_t>(whole + 1.0), last), share}};
  }
  std::vector<Weight> weights;
  for (auto i = static_cast<std::uint32_t>(from); i <= last && i < to; ++i)
    weights.push_back(
        {i, static_cast<float>((std::min(to, i + 1.0) - std::max(from, static_cast<double>(i))) / scale)});
  return weights;
}

/// fetch(x, y): texel of the source.
template <class Fetch>
BladeImage resampled(const Fetch& fetch, uvec2 source_size, uvec2 size) {
  std::vector<vec4> lines(std::size_t{size.x} * source_size.y);  // of the target's width
  for (std::uint32_t x = 0; x < size.x; ++x) {
    const std::vector<Weight> weights = weights_of(x, size.x, source_size.x);
    for (std::uint32_t y = 0; y < source_size.y; ++y)
      for (const Weight& weight : weights) lines[std::size_t{y} * size.x + x] += weight.share * fetch(weight.from, y);
  }
  BladeImage made{size.x, size.y, std::vector<vec4>(std::size_t{size.x} * size.y)};
  for (std::uint32_t y = 0; y < size.y; ++y)
    for (const Weight& weight : weights_of(y, size.y, source_size.y))
      for (std::uint32_t x = 0; x < size.x; ++x)
        made.texels[std::size_t{y} * size.x + x] += weight.share * lines[std::size_t{weight.from} * size.x + x];
  return made;
}

BladeImage in_size(const BladeImage& image, uvec2 size) {
  if (image.width == size.x && image.height == size.y) return image;
  return resampled([&](std::uint32_t x, std::uint32_t y) { return image.texels[std::size_t{y} * image.width + x]; },
                   uvec2(image.width, image.height), size);
}

/// A layer and its mips down to one texel. Sides are powers of two.
std::vector<BladeImage> mips_of(BladeImage image) {
  std::vector<BladeImage> mips;
  mips.push_back(std::move(image));
  while (mips.back().width > 1 || mips.back().height > 1) {
    const BladeImage& finer = mips.back();
    mips.push_back(in_size(finer, uvec2(std::max(finer.width / 2, 1u), std::max(finer.height / 2, 1u))));
  }
  return mips;
}

/// Divides colours by alpha. A texel without alpha takes the colour of the next mip's.
void divide_by_alpha(std::vector<BladeImage>& mips) {
  for (std::size_t mip = mips.size(); mip-- > 0;) {
    BladeImage& image = mips[mip];
    for (std::uint32_t y = 0; y < image.height; ++y)
      for (std::uint32_t x = 0; x < image.width; ++x) {
        vec4& texel = image.texels[std::size_t{y} * image.width + x];
        if (texel.w > 0.0f) {
          texel = vec4(vec3(texel) / texel.w, texel.w);
        } else if (mip + 1 < mips.size()) {
          const BladeImage& coarser = mips[mip + 1];
          const std::uint32_t cx = std::min(x / 2, coarser.width - 1), cy = std::min(y / 2, coarser.height - 1);
          texel = vec4(vec3(coarser.texels[std::size_t{cy} * coarser.width + cx]), 0.0f);
        }
      }
  }
}

}  // namespace

Result<std::vector<BladeImage>> blade_layers(const Image& image, std::uint32_t count) {
  const std::uint32_t width = image.width, height = image.height;
  const auto fault = [&](const std::string& text) {
    return Error{ErrorKind::input, "the image of " + std::to_string(width) + " x " + std::to_string(height) +
                                       " pixels has " + text + "; gloam.grass.texture_layers says how many it has"};
  };
  if (count == 0) count = width > height && width % height == 0 ? width / height : 1;
  if (count > kMostImageLayers)
    return fault(std::to_string(count) + " layers side by side, and at most " + std::to_string(kMostImageLayers) +
                 " are possible");
  if (width % count != 0) return fault("no width for " + std::to_string(count) + " layers of whole pixels");
  const uvec2 one(width / count, height);
  const uvec2 size(std::min(one.x, kMostBladeWidth), std::min(one.y, kMostBladeHeight));
  const auto& linear = linear_of_srgb();
  std::vector<BladeImage> layers;
  for (std::uint32_t layer = 0; layer < count; ++layer)
    layers.push_back(resampled(
        [&](std::uint32_t x, std::uint32_t y) {
          const std::uint8_t* texel = &image.rgba[4 * (std::size_t{y} * width + layer * one.x + x)];
          const float alpha = static_cast<float>(texel[3]) / 255.0f;
          return vec4(alpha * vec3(linear[texel[0]], linear[texel[1]], linear[texel[2]]), alpha);
        },
        one, size));
  return layers;
}

BladeArray blade_array(std::span<const BladeImage> layers) {
  uvec2 most(1);
  for (const BladeImage& layer : layers) most = glm::max(most, uvec2(layer.width, layer.height));
  BladeArray made;
  made.width = std::bit_ceil(most.x);
  made.height = std::max(std::bit_ceil(most.y), kLeastBladeAspect * made.width);
  made.layers = static_cast<std::uint32_t>(layers.size());
  made.mips = static_cast<std::uint32_t>(std::bit_width(std::max(made.width, made.height)));
  made.texels.resize(made.mip_offset(made.mips));
  for (std::uint32_t layer = 0; layer < made.layers; ++layer) {
    std::vector<BladeImage> mips = mips_of(in_size(layers[layer], uvec2(made.width, made.height)));
    divide_by_alpha(mips);
    for (std::uint32_t mip = 0; mip < made.mips; ++mip) {
      std::uint8_t* to = &made.texels[made.mip_offset(mip) + layer * made.layer_bytes(mip)];
      for (const vec4& texel : mips[mip].texels) {
        for (int c = 0; c < 3; ++c) *to++ = byte_of(linear_to_srgb(std::clamp(texel[c], 0.0f, 1.0f)));
        *to++ = byte_of(texel.w);
      }
    }
  }
  return made;
}

}  // namespace gloam
