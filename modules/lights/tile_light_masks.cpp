// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// FF §2.1.2. Our own: a rectangle is the product of a set of columns and a set of rows, so a tile's mask of rectangles is a mask of its
// column AND a mask of its row, and both kinds of masks are running exclusive ors of where rectangles begin and end.
#include "modules/lights/tile_light_masks.h"

#include <algorithm>

#include "engine/core/assert.h"
#include "modules/lights/cpu_clones.h"
#include "modules/lights/tile_mask_rows.h"

namespace gloam {
namespace {

constexpr std::size_t kLightGrain = 256;               // lights a job
constexpr std::size_t kRowGrain = 2;                   // rows of tiles a job
constexpr std::size_t kGrainWords = kLightGrain / 32;  // of a mask
constexpr std::size_t kMostVectorLights = 512;         // of the widest vector: and_tile_row reads whole ones
static_assert(sizeof(LineToggles::words) == kGrainWords * sizeof(std::uint32_t));

/// Words of `count` columns or rows from where lights begin and end. Leaves toggles 0, of which there is one more.
GLOAM_CPU_CLONES void sum_lines(LineToggles* toggles, std::size_t count, std::size_t first_word, TileLine* lines) {
  std::uint32_t sums[kGrainWords] = {};
  for (std::size_t line = 0; line < count; ++line) {
    std::uint32_t* const words = lines[line].words + first_word;
    for (std::size_t w = 0; w < kGrainWords; ++w) {
      sums[w] ^= toggles[line].words[w];
      toggles[line].words[w] = 0;
      words[w] = sums[w];
    }
  }
  toggles[count] = {};
}

/// A job's lights, whose words start at first_word, in the first `count` columns or rows.
void build_lines(const std::vector<std::int32_t>& begins, const std::vector<std::int32_t>& ends, JobRange range,
                 std::size_t count, LineToggles* toggles, std::vector<TileLine>& lines) {
  const std::size_t first_word = range.ordinal * kGrainWords;
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const std::uint32_t bit = 1u << (i % 32);
    const std::size_t word = i / 32 - first_word;
    toggles[static_cast<std::size_t>(begins[i])].words[word] ^= bit;
    toggles[static_cast<std::size_t>(ends[i])].words[word] ^= bit;
  }
  sum_lines(toggles, count, first_word, lines.data());
}

/// What the jobs of one call share.
struct MaskJob {
  std::span<const MaskLight> lights;
  const RenderView& view;
  TileProjection projection;
  OutlineDetail detail;
  TileLightMasks& masks;

  void outline(JobRange range) const { find_outlines(lights, view, projection, detail, range, masks.scratch.outlines); }

  void build_columns_and_rows(JobRange range) const {
    range.begin = std::min(range.begin, lights.size());
    range.end = std::min(range.end, lights.size());
    outline(range);
    TileMaskScratch& scratch = masks.scratch;
    const TileOutlines& outlines = scratch.outlines;
    LineToggles* const toggles = scratch.toggles.data() + range.ordinal * toggle_count();
    build_lines(outlines.column_begin, outlines.column_end, range, projection.columns, toggles, scratch.columns);
    build_lines(outlines.row_begin, outlines.row_end, range, projection.rows, toggles + projection.columns + 1,
                scratch.rows);
  }

  /// Of a job.
  [[nodiscard]] std::size_t toggle_count() const { return std::size_t{projection.columns} + projection.rows + 2; }

  void and_rows(JobRange range) const {
    const std::size_t words = std::max<std::size_t>(1, (lights.size() + 31) / 32);
    const VectorWidth width = widest_vectors();
    for (std::size_t row = range.begin; row < range.end; ++row) {
      and_tile_row(width, masks.scratch.columns.data()->words, masks.scratch.rows[row].words, projection.columns, words,
                   masks.words.data() + row * projection.columns * GLOAM_MASK_WORDS);
    }
  }

  void write_rows(JobRange range) const {
    write_row_intervals(masks.scratch.outlines, lights.size(), projection, detail == OutlineDetail::cones, range,
                        masks.scratch.bands[range.ordinal], masks.words.data());
  }
};

}  // namespace

void build_tile_light_masks(std::span<const MaskLight> lights, const RenderView& view, TileBound bound,
                            JobExecutor& executor, TileLightMasks& masks) {
  GLOAM_ASSERT(lights.size() <= GLOAM_MAX_LOCAL_LIGHTS,
               "masks have a bit for each of at most GLOAM_MAX_LOCAL_LIGHTS lights");
  MaskJob job{lights, view, tile_projection(view), OutlineDetail::rectangles, masks};
  const TileProjection& p = job.projection;

  if (bound == TileBound::row_interval) job.detail = OutlineDetail::ellipses;
  if (bound == TileBound::cone) job.detail = OutlineDetail::cones;
  masks.tiles = uvec2(p.columns, p.rows);
  masks.words.resize(std::size_t{p.columns} * p.rows * GLOAM_MASK_WORDS);
  masks.scratch.outlines.resize(lights.size());

  if (job.detail == OutlineDetail::rectangles) {
    const std::size_t jobs = std::max<std::size_t>(1, (lights.size() + kMostVectorLights - 1) / kMostVectorLights) *
                             (kMostVectorLights / kLightGrain);
    masks.scratch.columns.resize(p.columns);
    masks.scratch.rows.resize(p.rows);
    masks.scratch.toggles.resize(jobs * job.toggle_count());
    executor.parallel_for(jobs * kLightGrain, kLightGrain,
                          [&job](JobRange range) { job.build_columns_and_rows(range); });
    executor.parallel_for(p.rows, kRowGrain, [&job](JobRange range) { job.and_rows(range); });
    return;
  }
  executor.parallel_for(lights.size(), kLightGrain, [&job](JobRange range) { job.outline(range); });
  // Few bands: each looks at every light.
  const std::size_t wanted = executor.worker_count() == 1 ? 1 : 2 * std::size_t{executor.worker_count()};
  const std::size_t grain =
      std::clamp<std::size_t>((p.rows + wanted - 1) / wanted, std::min<std::size_t>(8, p.rows), kMostBandRows);
  masks.scratch.bands.resize(std::max(masks.scratch.bands.size(), (p.rows + grain - 1) / grain));
  executor.parallel_for(p.rows, grain, [&job](JobRange range) { job.write_rows(range); });
}

}  // namespace gloam
