// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/jobs/executor.h"
#include "modules/lights/masks/tile_outlines.h"

namespace gloam {

inline constexpr std::size_t kMostBandRows = 80;  ///< most rows of tiles per job

/// A light's columns in one row of tiles: begin in bits 0…10, end (exclusive) in bits 11…21, light index from bit 22.
using RowInterval = std::uint32_t;

/// Intermediate results of one job, reused between calls.
struct TileBand {
  std::vector<RowInterval> intervals;  ///< room for every light in every row
  std::vector<std::uint32_t> counts;   ///< intervals in use, per row
  std::vector<std::uint32_t> toggles;  ///< 32 words per column, plus one extra column; all 0 between calls
};

/// Writes the tiles of rows [rows.begin, rows.end), at most kMostBandRows, from the outlines of `count` lights.
/// `cones`: also clip to the lines of OutlineDetail::cones. `tiles`: the masks of the whole image, GLOAM_MASK_WORDS per
/// tile.
void write_row_intervals(const TileOutlines& outlines, std::size_t count, const TileProjection& projection, bool cones,
                         JobRange rows, TileBand& band, std::uint32_t* tiles);

}  // namespace gloam
