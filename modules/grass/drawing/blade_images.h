// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Images of blades: layers side by side in files, and one array of them for the GPU.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/result.h"
#include "engine/math/types.h"
#include "engine/scene/assets.h"

namespace gloam {

/// Most layers of one image: growth gives blades as many.
inline constexpr std::uint32_t kMostImageLayers = 16;
/// Most layers of all images of a scene.
inline constexpr std::uint32_t kMostBladeLayers = 64;
/// Most texels of a layer across and along a blade; powers of two. Larger images are averaged.
inline constexpr std::uint32_t kMostBladeWidth = 128;
inline constexpr std::uint32_t kMostBladeHeight = 1024;
/// A layer is at least this many times as high as wide: blades are long, and a mip that is one texel wide, which a
/// blade of one pixel's width shows, still has rows from root to tip.
inline constexpr std::uint32_t kLeastBladeAspect = 8;

/// One layer. Texels are linear light times alpha, and alpha; rows from the tip to the root.
struct BladeImage {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<vec4> texels;
};

/// Layers of one size with all mips, as the GPU holds them: sRGB bytes of the colour without alpha, and alpha. Mip by
/// mip, and layer by layer in each mip. Sides are powers of two.
struct BladeArray {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t layers = 0;
  std::uint32_t mips = 0;
  std::vector<std::uint8_t> texels;

  [[nodiscard]] std::uint32_t mip_width(std::uint32_t mip) const { return width >> mip > 0 ? width >> mip : 1; }
  [[nodiscard]] std::uint32_t mip_height(std::uint32_t mip) const { return height >> mip > 0 ? height >> mip : 1; }
  /// Bytes of one layer of a mip, and where a mip begins.
  [[nodiscard]] std::size_t layer_bytes(std::uint32_t mip) const {
    return std::size_t{4} * mip_width(mip) * mip_height(mip);
  }
  [[nodiscard]] std::size_t mip_offset(std::uint32_t mip) const {
    std::size_t offset = 0;
    for (std::uint32_t i = 0; i < mip; ++i) offset += layers * layer_bytes(i);
    return offset;
  }
};

/// The layers of an image, side by side, each at most kMostBladeWidth × kMostBladeHeight. count: 0…kMostImageLayers; 0:
/// as many as the image's width has heights, if that is a whole number above 1, else one. Input error, without the
/// place, if the image has not that many layers.
[[nodiscard]] Result<std::vector<BladeImage>> blade_layers(const Image& image, std::uint32_t count);

/// All layers in the size of the largest. At least one layer. The mean colour of what alpha shows, and the mean alpha,
/// are the same in all mips. Texels without alpha have the colour of those around them.
[[nodiscard]] BladeArray blade_array(std::span<const BladeImage> layers);

}  // namespace gloam
