// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/jobs/executor.h"
#include "modules/lights/tile_outlines.h"

namespace gloam {

inline constexpr std::size_t kMostBandRows = 80;  ///< rows of tiles that one job looks at

/// A light's interval in one row of tiles: where its bit changes in 32 words a column, and the bit.
struct RowInterval {
  std::uint16_t begin = 0;
  std::uint16_t end = 0;
  std::uint32_t bit = 0;
};

/// What one job finds about its rows, and keeps from one time to the next.
struct TileBand {
  std::vector<RowInterval> intervals;  ///< room for every light in every row
  std::vector<std::uint32_t> counts;   ///< a row: of its room, how many there are
  std::vector<std::uint32_t> toggles;  ///< 32 words a column and one column more; 0 between calls
};

/// Writes the tiles of rows [rows.begin, rows.end) — at most kMostBandRows — from the outlines of `count` lights. `cones`: with the lines
/// of OutlineDetail::cones. `tiles`: of the whole picture, GLOAM_MASK_WORDS each.
void write_row_intervals(const TileOutlines& outlines, std::size_t count, const TileProjection& projection, bool cones,
                         JobRange rows, TileBand& band, std::uint32_t* tiles);

}  // namespace gloam
