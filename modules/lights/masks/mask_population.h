// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "engine/math/types.h"
#include "modules/lights/masks/tile_light_masks.h"

namespace gloam {

/// The most list entries that a view's shadow tiles can need: for each shadow tile the lights in the mask of the tile
/// of 32×32 pixels around it, rounded up to a multiple of `step`. shadow_tiles: columns and rows, in the part of the
/// view that the masks cover. chosen: which lights count, bit i % 32 of word i / 32; empty: all.
[[nodiscard]] std::uint64_t mask_population(const TileLightMasks& masks, uvec2 shadow_tiles,
                                            std::span<const std::uint32_t> chosen, std::uint32_t step);

/// The same sum over some shadow tiles only, not rounded up. counted: bit i % 32 of word i / 32 for the tile of index
/// i = row · columns + column.
[[nodiscard]] std::uint64_t mask_population_of(const TileLightMasks& masks, uvec2 shadow_tiles,
                                               std::span<const std::uint32_t> counted,
                                               std::span<const std::uint32_t> chosen);

}  // namespace gloam
