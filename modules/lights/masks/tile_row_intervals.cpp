// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// Column intervals of lights in each row of tiles. A row of tiles is a band between two slopes (its edges). A convex
// outline reaches its extreme columns within a band either on one of the two edges or at its own leftmost or rightmost
// point, if that point is in the band. Step 1, per light: left and right columns at all edges, vectorized over edges.
// Step 2: each interval becomes two toggle bits in its row. Step 3: the running exclusive or along the row gives the
// masks.
#include "modules/lights/masks/tile_row_intervals.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/assert.h"
#include "modules/lights/cpu_clones.h"
#include "modules/lights/masks/tile_light_masks.h"
#include "modules/lights/masks/tile_mask_rows.h"

namespace gloam {
namespace {

constexpr std::size_t kLanes = 8;
constexpr std::size_t kEdges = kMostBandRows + 2 * kLanes;
constexpr std::uint32_t kEndShift = 11;
constexpr std::uint32_t kLightShift = 22;
constexpr std::uint32_t kColumnMask = (1u << kEndShift) - 1;
constexpr float kMargin = 1.0f / (32 * 16);  // columns: a sixteenth of a pixel, more than the rounding error of floats

GLOAM_CPU_INLINE float smaller(float a, float b) { return a < b ? a : b; }
GLOAM_CPU_INLINE float greater(float a, float b) { return a > b ? a : b; }

/// The row edges of a band, and the rows it covers.
struct BandEdges {
  std::array<float, kEdges> slopes;
  std::int32_t first_row;
  std::int32_t end_row;
  float width;    ///< width of the image in columns
  float squared;  ///< 1: perspective, the term s² of q counts; 0: orthographic
};

BandEdges band_edges(const TileProjection& p, JobRange rows) {
  BandEdges edges;
  for (std::size_t e = 0; e < kEdges; ++e)
    edges.slopes[e] =
        static_cast<float>((std::min(static_cast<double>(rows.begin + e), p.height) - p.row_offset) / p.row_scale);
  edges.first_row = static_cast<std::int32_t>(rows.begin);
  edges.end_row = static_cast<std::int32_t>(rows.end);
  edges.width = static_cast<float>(p.width);
  edges.squared = p.perspective ? 1.0f : 0.0f;
  return edges;
}

/// Columns of TileOutlines as plain pointers, so that the compiler vectorizes loops over them.
struct Outlines {
  const std::int32_t *column_begin, *column_end, *row_begin, *row_end, *leftmost_row, *rightmost_row;
  const float *middle, *lean, *half, *radius2, *row_slope, *least_slope, *greatest_slope;
  const float *left_slope[2], *left_bound[2], *right_slope[2], *right_bound[2];
};

Outlines outlines_of(const TileOutlines& o) {
  Outlines out{o.column_begin.data(),
               o.column_end.data(),
               o.row_begin.data(),
               o.row_end.data(),
               o.leftmost_row.data(),
               o.rightmost_row.data(),
               o.middle.data(),
               o.lean.data(),
               o.half.data(),
               o.radius2.data(),
               o.row_slope.data(),
               o.least_slope.data(),
               o.greatest_slope.data(),
               {},
               {},
               {},
               {}};
  for (int side = 0; side < 2; ++side) {
    out.left_slope[side] = o.lines[side].left_slope.data();
    out.left_bound[side] = o.lines[side].left_bound.data();
    out.right_slope[side] = o.lines[side].right_slope.data();
    out.right_bound[side] = o.lines[side].right_bound.data();
  }
  return out;
}

/// Left and right columns of one light at the edges of its rows.
struct EdgeColumns {
  alignas(64) float left[kEdges];
  alignas(64) float right[kEdges];
  alignas(64) float line_left[2][kEdges];
  alignas(64) float line_right[2][kEdges];
};

struct RowColumns {
  alignas(64) RowInterval intervals[kEdges];
  alignas(64) std::uint32_t filled[kEdges];  ///< 1; 0 if the interval is empty
};

template <bool kCones>
GLOAM_CPU_INLINE void find_edges(const Outlines& o, std::size_t i, const float* slopes, float squared,
                                 std::size_t edge_count, EdgeColumns& out) {
  const float middle = o.middle[i], lean = o.lean[i], half = o.half[i], radius2 = o.radius2[i],
              row_slope = o.row_slope[i];
  const float least = o.least_slope[i], greatest = o.greatest_slope[i];
  for (std::size_t block = 0; block < edge_count; block += kLanes) {
    for (std::size_t e = block; e < block + kLanes; ++e) {
      const float slope = smaller(greater(slopes[e], least), greatest);
      const float away = slope - row_slope;
      const float q = radius2 * (1.0f + squared * slope * slope) - away * away;
      const float reach = half * std::sqrt(greater(q, 0.0f)) + kMargin;
      const float center = middle + lean * slope;
      out.left[e] = center - reach;
      out.right[e] = center + reach;
      if constexpr (kCones) {
        out.line_left[0][e] = o.left_bound[0][i] + o.left_slope[0][i] * slope;
        out.line_left[1][e] = o.left_bound[1][i] + o.left_slope[1][i] * slope;
        out.line_right[0][e] = o.right_bound[0][i] + o.right_slope[0][i] * slope;
        out.line_right[1][e] = o.right_bound[1][i] + o.right_slope[1][i] * slope;
      }
    }
  }
}

template <bool kCones>
GLOAM_CPU_INLINE void find_rows(const EdgeColumns& edges, std::int32_t leftmost, std::int32_t rightmost,
                                std::int32_t column_begin, std::int32_t column_end, float width, std::size_t row_count,
                                std::uint32_t light_bits, RowColumns& rows) {
  const auto first = static_cast<float>(column_begin);
  const auto last = static_cast<float>(column_end - 1);
  for (std::size_t block = 0; block < row_count; block += kLanes) {
    for (std::size_t r = block; r < block + kLanes; ++r) {
      float left = smaller(edges.left[r], edges.left[r + 1]);
      float right = greater(edges.right[r], edges.right[r + 1]);
      left = static_cast<std::int32_t>(r) == leftmost ? first : left;
      right = static_cast<std::int32_t>(r) == rightmost ? last : right;
      if constexpr (kCones) {
        left = greater(left, smaller(edges.line_left[0][r], edges.line_left[0][r + 1]));
        left = greater(left, smaller(edges.line_left[1][r], edges.line_left[1][r + 1]));
        right = smaller(right, greater(edges.line_right[0][r], edges.line_right[0][r + 1]));
        right = smaller(right, greater(edges.line_right[1][r], edges.line_right[1][r + 1]));
      }
      right = left > width ? -1.0f : right;
      const auto begin = static_cast<std::int32_t>(smaller(greater(left, first), last + 1.0f));
      const auto end = static_cast<std::int32_t>(smaller(greater(right, first - 1.0f), last) + 1.0f);
      rows.filled[r] = end > begin ? 1u : 0u;
      rows.intervals[r] = light_bits | static_cast<std::uint32_t>(end > begin ? end : begin) << kEndShift |
                          static_cast<std::uint32_t>(begin);
    }
  }
}

/// Appends the light's intervals to the lists of its rows.
GLOAM_CPU_INLINE void append(const RowColumns& rows, std::size_t first_row, std::size_t row_count, std::size_t room,
                             RowInterval* intervals, std::uint32_t* counts) {
  for (std::size_t r = 0; r < row_count; ++r) {
    std::uint32_t& count = counts[first_row + r];
    intervals[(first_row + r) * room + count] = rows.intervals[r];
    count += rows.filled[r];
  }
}

template <bool kCones>
GLOAM_CPU_INLINE void list_intervals(const Outlines& o, std::size_t light_count, const BandEdges& band,
                                     std::size_t room, RowInterval* intervals, std::uint32_t* counts) {
  EdgeColumns edges;
  RowColumns rows;
  for (std::size_t i = 0; i < light_count; ++i) {
    const std::int32_t begin = o.row_begin[i] > band.first_row ? o.row_begin[i] : band.first_row;
    const std::int32_t end = o.row_end[i] < band.end_row ? o.row_end[i] : band.end_row;
    if (begin >= end) continue;
    const auto row_count = static_cast<std::size_t>(end - begin);
    const auto first_row = static_cast<std::size_t>(begin - band.first_row);
    find_edges<kCones>(o, i, band.slopes.data() + first_row, band.squared, row_count + 1, edges);
    find_rows<kCones>(edges, o.leftmost_row[i] - begin, o.rightmost_row[i] - begin, o.column_begin[i], o.column_end[i],
                      band.width, row_count, static_cast<std::uint32_t>(i) << kLightShift, rows);
    append(rows, first_row, row_count, room, intervals, counts);
  }
}

GLOAM_CPU_CLONES void list_ellipses(const Outlines& o, std::size_t light_count, const BandEdges& band, std::size_t room,
                                    RowInterval* intervals, std::uint32_t* counts) {
  list_intervals<false>(o, light_count, band, room, intervals, counts);
}

GLOAM_CPU_CLONES void list_cones(const Outlines& o, std::size_t light_count, const BandEdges& band, std::size_t room,
                                 RowInterval* intervals, std::uint32_t* counts) {
  list_intervals<true>(o, light_count, band, room, intervals, counts);
}

}  // namespace

void write_row_intervals(const TileOutlines& outlines, std::size_t count, const TileProjection& projection, bool cones,
                         JobRange rows, TileBand& band, std::uint32_t* tiles) {
  const std::size_t row_count = rows.end - rows.begin;
  const std::size_t columns = projection.columns;
  GLOAM_ASSERT(columns <= kColumnMask && count <= (1u << (32 - kLightShift)), "an interval fits 32 bits");
  band.intervals.resize(row_count *
                        (count + 1));  // one extra item: append writes an interval before it knows whether it is empty
  band.counts.assign(row_count, 0);
  band.toggles.resize((columns + 1) * kTileMaskWords);
  (cones ? list_cones : list_ellipses)(outlines_of(outlines), count, band_edges(projection, rows), count + 1,
                                       band.intervals.data(), band.counts.data());
  const VectorWidth width = widest_vectors();
  const std::size_t words = std::max<std::size_t>(1, (count + 31) / 32);
  for (std::size_t r = 0; r < row_count; ++r) {
    std::uint32_t* toggles = band.toggles.data();
    const RowInterval* begin = band.intervals.data() + r * (count + 1);
    for (std::uint32_t n = 0; n < band.counts[r]; ++n) {
      const RowInterval interval = begin[n];
      const std::size_t word = interval >> kLightShift >> 5;
      const std::uint32_t bit = 1u << (interval >> kLightShift & 31u);
      toggles[(interval & kColumnMask) * kTileMaskWords + word] ^= bit;
      toggles[(interval >> kEndShift & kColumnMask) * kTileMaskWords + word] ^= bit;
    }
    sum_tile_row(width, toggles, columns, words, tiles + (rows.begin + r) * columns * GLOAM_MASK_WORDS);
  }
}

}  // namespace gloam
