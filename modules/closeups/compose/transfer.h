// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "modules/shadows/outputs.h"
#include "shaders/closeups/closeups_shared.h"

namespace gloam {

/// The mip of a pair's face that transfer reads for a texel of a standard face: the finest mip in which the smaller
/// side of the covered area is at most two texels. `texels`: size of that area in texels of mip 0. `size`: side of the
/// pair's face. Same as level_of in transfer.glsl.
[[nodiscard]] std::uint32_t transfer_level(vec2 texels, std::uint32_t size);

/// Constants to transfer the depths of `from`, a face in a close-up map of side `map_size`, to `texels` of `to`, a
/// standard face of the same light. Both faces are perspective with the same origin, or orthographic with the same
/// direction. depth_bits is set to keep all bits.
[[nodiscard]] shaders::CloseupTransfer transfer_constants(const ShadowFace& from, std::uint32_t map_size,
                                                          const ShadowFace& to, const TexelRect& texels);

}  // namespace gloam
