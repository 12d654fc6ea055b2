// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Tile light masks: FF §2.1.2. Not from the paper: a rectangle is the product of a column set and a row set. The mask
// of a tile is therefore its column mask AND its row mask. Each column or row mask is the running exclusive or of
// toggle bits, set where a rectangle begins and where it ends.
#include "modules/lights/masks/tile_light_masks.h"

#include <algorithm>

#include "engine/core/assert.h"
#include "modules/lights/cpu_clones.h"
#include "modules/lights/masks/tile_mask_rows.h"

namespace gloam {
namespace {

constexpr std::size_t kOutlineGrain = 256;  // lights per job
constexpr std::size_t kRowGrain = 4;        // rows of tiles per job

/// State that the jobs of one call share.
struct MaskJob {
  std::span<const MaskLight> lights;
  const ViewProjection& view;
  TileProjection projection;
  OutlineDetail detail;
  TileLightMasks& masks;

  void outline(JobRange range) const { find_outlines(lights, view, projection, detail, range, masks.scratch.outlines); }

  void and_rows(JobRange range) const {
    const std::size_t words = std::max<std::size_t>(1, (lights.size() + 31) / 32);
    const VectorWidth width = widest_vectors();
    for (std::size_t row = range.begin; row < range.end; ++row) {
      and_tile_row(width, masks.scratch.column_masks.data(), masks.scratch.row_masks.data() + row * kTileMaskWords,
                   projection.columns, words, masks.words.data() + row * projection.columns * GLOAM_MASK_WORDS);
    }
  }

  void write_rows(JobRange range) const {
    write_row_intervals(masks.scratch.outlines, lights.size(), projection, detail == OutlineDetail::cones, range,
                        masks.scratch.bands[range.ordinal], masks.words.data());
  }
};

GLOAM_CPU_CLONES void sum_lines(std::uint32_t* words, std::size_t tiles) {
  std::uint32_t sums[kTileMaskWords] = {};
  for (std::size_t tile = 0; tile < tiles; ++tile, words += kTileMaskWords)
    for (std::size_t w = 0; w < kTileMaskWords; ++w) words[w] = sums[w] ^= words[w];
}

/// Builds the mask of each of `tiles` columns (or rows) from the columns (rows) where lights begin and end.
void build_line_masks(std::span<const std::int32_t> begins, std::span<const std::int32_t> ends, std::size_t count,
                      std::size_t tiles, std::vector<std::uint32_t>& masks) {
  masks.assign((tiles + 1) * kTileMaskWords, 0);
  std::uint32_t* words = masks.data();
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t bit = 1u << (i % 32);
    words[static_cast<std::size_t>(begins[i]) * kTileMaskWords + i / 32] ^= bit;
    words[static_cast<std::size_t>(ends[i]) * kTileMaskWords + i / 32] ^= bit;
  }
  sum_lines(words, tiles);
}

}  // namespace

void build_tile_light_masks(std::span<const MaskLight> lights, const ViewProjection& view, TileBound bound,
                            JobExecutor& executor, TileLightMasks& masks) {
  GLOAM_ASSERT(lights.size() <= GLOAM_MAX_LOCAL_LIGHTS,
               "masks have a bit for each of at most GLOAM_MAX_LOCAL_LIGHTS lights");
  MaskJob job{lights, view, tile_projection(view), OutlineDetail::rectangles, masks};
  const TileProjection& p = job.projection;

  if (bound == TileBound::row_interval) job.detail = OutlineDetail::ellipses;
  if (bound == TileBound::cone) job.detail = OutlineDetail::cones;
  masks.tiles = uvec2(p.columns, p.rows);
  masks.words.resize(std::size_t{p.columns} * p.rows * GLOAM_MASK_WORDS);
  TileOutlines& outlines = masks.scratch.outlines;
  outlines.resize(lights.size());
  executor.parallel_for(lights.size(), kOutlineGrain, [&job](JobRange range) { job.outline(range); });

  if (job.detail == OutlineDetail::rectangles) {
    build_line_masks(outlines.column_begin, outlines.column_end, lights.size(), p.columns, masks.scratch.column_masks);
    build_line_masks(outlines.row_begin, outlines.row_end, lights.size(), p.rows, masks.scratch.row_masks);
    executor.parallel_for(p.rows, kRowGrain, [&job](JobRange range) { job.and_rows(range); });
    return;
  }
  // Few bands, because each band loops over every light.
  const std::size_t wanted = executor.worker_count() == 1 ? 1 : 2 * std::size_t{executor.worker_count()};
  const std::size_t grain =
      std::clamp<std::size_t>((p.rows + wanted - 1) / wanted, std::min<std::size_t>(8, p.rows), kMostBandRows);
  masks.scratch.bands.resize(std::max(masks.scratch.bands.size(), (p.rows + grain - 1) / grain));
  executor.parallel_for(p.rows, grain, [&job](JobRange range) { job.write_rows(range); });
}

}  // namespace gloam
