// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "modules/shadows/outputs.h"
#include "shaders/closeups/closeups_shared.h"

namespace gloam {

/// Mip of a close-up map that a texel of a standard face is made from when it covers so many texels of mip 0: the
/// finest that has at most two across the smaller side. Twin of transfer.comp's.
[[nodiscard]] std::uint32_t transfer_level(vec2 texels, std::uint32_t size);

/// How what `from` holds, a face in a close-up map of side `map_size`, moves into these texels of `to`, a face of the
/// same light. Both are perspective from one point, or both orthographic along one direction. Depths keep all bits.
[[nodiscard]] shaders::CloseupTransfer transfer_constants(const ShadowFace& from, std::uint32_t map_size,
                                                          const ShadowFace& to, const TexelRect& texels);

}  // namespace gloam
