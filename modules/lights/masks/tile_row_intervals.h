// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/jobs/executor.h"
#include "modules/lights/masks/tile_outlines.h"

namespace gloam {

inline constexpr std::size_t kMostBandRows = 80;  ///< rows of tiles that one job looks at

/// A light's columns in one row of tiles: begin in bits 0…10, end (behind the last) in bits 11…21, the light from bit
/// 22 on.
using RowInterval = std::uint32_t;

/// What one job finds about its rows, and keeps from one time to the next.
struct TileBand {
  std::vector<RowInterval> intervals;  ///< room for every light in every row
  std::vector<std::uint32_t> counts;   ///< a row: of its room, how many there are
  std::vector<std::uint32_t> toggles;  ///< 32 words a column and one column more; 0 between calls
};

/// Writes the tiles of rows [rows.begin, rows.end) — at most kMostBandRows — from the outlines of `count` lights.
/// `cones`: with the lines of OutlineDetail::cones. `tiles`: of the whole picture, GLOAM_MASK_WORDS each.
void write_row_intervals(const TileOutlines& outlines, std::size_t count, const TileProjection& projection, bool cones,
                         JobRange rows, TileBand& band, std::uint32_t* tiles);

}  // namespace gloam
