// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "engine/math/types.h"

/// Layout of mips in an atlas and in its pyramid: mip 0 is the square on the left; the smaller ones are to its right,
/// one below the other. The CPU counterpart of mip_corner in shaders/shadows/maps/mips.glsl.
namespace gloam {

/// Upper left texel of a mip. size: side of mip 0 in texels, a power of two. mip: 0 … log2(size).
[[nodiscard]] constexpr uvec2 mip_corner(std::uint32_t size, std::uint32_t mip) {
  return mip == 0 ? uvec2(0) : uvec2(size, size - (2 * size >> mip));
}

/// Width and height in texels of an image that holds all mips.
[[nodiscard]] constexpr uvec2 size_with_mips(std::uint32_t size) { return {size + size / 2, size}; }

}  // namespace gloam
