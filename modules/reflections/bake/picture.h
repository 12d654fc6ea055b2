// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "engine/math/types.h"

namespace gloam {

/// Linear light, rows from the top. rgb: cd/m² · ReflectionCaptures::light_scale, premultiplied by alpha.
struct CapturedPicture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<vec4> texels;
};

/// Luminance (Rec. 709) of linear light.
[[nodiscard]] inline double luminance_of(const dvec3& light) {
  return 0.2126 * light.x + 0.7152 * light.y + 0.0722 * light.z;
}

/// The light as half floats can hold it: NaN and negative numbers become 0, large ones 65504. A capture without this
/// would spread one bad pixel over all mips.
[[nodiscard]] vec3 storable(const vec3& light);

/// The picture as a square of `side` texels. Each texel is the mean of the texels it covers, or an interpolation where
/// the picture is smaller.
[[nodiscard]] CapturedPicture resampled(const CapturedPicture& picture, std::uint32_t side);

/// Appends half floats of the picture: RGBA, rows from the top. Values must be storable().
void append_halves(const CapturedPicture& picture, std::vector<std::uint16_t>& halves);

/// Appends a square picture, whose side is a power of two, and all its box-filtered mips down to 1 texel.
void append_mip_chain(CapturedPicture picture, std::vector<std::uint16_t>& halves);

}  // namespace gloam
