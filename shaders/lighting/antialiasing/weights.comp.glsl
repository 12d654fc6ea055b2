// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/antialiasing/edge_bits.glsl"
#include "shaders/lighting/lighting_shared.h"

// Shares of each pixel that its neighbours cover, after Jimenez et al. 2012 ("SMAA"), section 3, with other means: the
// search counts bits, the areas are computed, and ends of edges are judged by the side of the brighter pixels.
//
// A slanted contour is a stair of straight edges. An edge of length d ends in steps: at each end the contour goes
// across it for one pixel, to one side or the other, and then on, away from the edge. The contour is taken to run from
// the middle of the step at the first end to the middle of the edge, and from there to the middle of the step at the
// last end. An end without a step has none of the line: where the contour has a corner or turns back, or where the edge
// fades. So straight edges, right angles, dots and the ends of thin lines stay.

layout(local_size_x = 32) in;

layout(push_constant, scalar) uniform Weights { AntialiasingConstants c; };
layout(set = 0, binding = 0, scalar) readonly buffer EdgeWords { uvec2 edge_words[]; };
// Up, down, left and right of a pixel; only of pixels whose bit in masks is set.
layout(set = 0, binding = 1, scalar) writeonly buffer PixelWeights { uint weights[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Masks { uint masks[]; };
layout(set = 0, binding = 3, scalar) buffer BlendCommand { uvec4 blend_command; };  // x: number of vertices
// That hold all pixels with a share: first pixel, and number of pixels along both axes; y in the upper 16 bits.
layout(set = 0, binding = 4, scalar) writeonly buffer Rectangles { uvec2 rectangles[]; };

const uint kReach = 32u;  // farthest end of an edge that is found, pixels

// Number of ones in a row downward from bit number count − 1. count: 0…32.
uint ones_below(uint word, uint count) {
  uint zeros = count == 0u ? 0xFFFFFFFFu : ~(word << (32u - count));
  return zeros == 0u ? 32u : 31u - uint(findMSB(zeros));
}
// Number of ones in a row upward from bit 0.
uint ones_above(uint word) { return ~word == 0u ? 32u : uint(findLSB(~word)); }

uint plane(uvec2 planes, bool first) { return first ? planes.x : planes.y; }

uvec2 word_at(bool rows, uint line, uint word) { return edge_words[first_word(rows, c.size, line) + word]; }

// The edge at a position of a line, in both planes. position: −1 to the line's length.
uvec2 edge_at(bool rows, uint line, uint position) {
  uint bit = position + 32u;
  return word_at(rows, line, bit / 32u) >> (bit % 32u) & 1u;
}

// The step at an end of an edge: 1 to the side of the pixels before the edge, 2 to the other side, 0 none. end: the
// line that crosses the end of the edge; beyond: the position behind the end. The contour has the same pixels on its
// brighter side all along.
uint step_at(bool rows, uint line, uint end, uint beyond, bool before_is_brighter, bool first_end) {
  bool turned = before_is_brighter != first_end;
  uint before =
      plane(edge_at(!rows, end, line - 1u), turned) & plane(edge_at(rows, line - 1u, beyond), before_is_brighter);
  uint after = plane(edge_at(!rows, end, line), !turned) & plane(edge_at(rows, line + 1u, beyond), before_is_brighter);
  return before == after ? 0u : (before != 0u ? 1u : 2u);
}

// Area between the edge and the line from 0.5 at an end down to 0 at the middle, in pixel number k from that end.
float area(uint k, uint length) {
  float reach = 0.5 * float(length) - float(k);
  if (reach <= 0.0) return 0.0;
  return reach >= 1.0 ? (reach - 0.5) / float(length) : 0.5 * reach * reach / float(length);
}

// The areas that the contour cuts off the pixel before an edge (x) and the pixel after it (y). rows: the edge lies
// between rows.
vec2 cut_areas(bool rows, uint line, uint position, bool before_is_brighter) {
  uint word = position / 32u + 1u, bit = position % 32u;
  uint own = plane(word_at(rows, line, word), before_is_brighter);
  uint back = ones_below(own, bit), forth = ones_above(own >> bit) - 1u;
  if (back == bit) back += ones_below(plane(word_at(rows, line, word - 1u), before_is_brighter), 32u);
  if (bit + forth == 31u) forth += ones_above(plane(word_at(rows, line, word + 1u), before_is_brighter));

  uint begins = 0u, ends = 0u;
  if (back <= kReach) begins = step_at(rows, line, position - back, position - back - 1u, before_is_brighter, true);
  uint end = position + forth + 1u;
  if (forth <= kReach) ends = step_at(rows, line, end, end, before_is_brighter, false);
  back = min(back, kReach);
  forth = min(forth, kReach);
  float from_begin = area(back, back + forth + 1u), from_end = area(forth, back + forth + 1u);
  return vec2((begins == 1u ? from_begin : 0.0) + (ends == 1u ? from_end : 0.0),
              (begins == 2u ? from_begin : 0.0) + (ends == 2u ? from_end : 0.0));
}

// The workgroup's block of 32 × 16 pixels: its data fit the 16 KiB that every device has. Threads take edges and pixels
// from lists in turn, so all have work although rows have different numbers of edges.
const uint kBlockRows = 16u;
const uint kEdgeColumns = 1u << 11u, kEdgeBright = 1u << 12u;
// Edges: position (5 bits), line (6 bits), flags: of a column's line, first plane. Then the pixels with a share: column
// (5 bits), row.
shared uint items[(kBlockRows + 1u) * 32u + 33u * kBlockRows];
shared uint edge_count;
shared float shares[kBlockRows * 32u][4];  // up, down, left, right of a pixel; only of those with a bit in has_share
shared uint has_share[4][kBlockRows];      // a bit for each pixel of a row
shared uint pixel_count;

// Lists the edges on all four sides of the block's pixels. line: of the rows, then of the columns.
void list_edges(uvec2 first, uint line) {
  bool rows = line <= kBlockRows;
  uint own = rows ? line : line - kBlockRows - 1u, at = rows ? first.y + own : first.x + own;
  if (at > (rows ? c.size.y : c.size.x)) return;
  uvec2 planes = word_at(rows, at, (rows ? first.x : first.y) / 32u + 1u);
  if (!rows) planes = planes >> (first.y % 32u) & ((1u << kBlockRows) - 1u);
  uint both = planes.x | planes.y, place = atomicAdd(edge_count, uint(bitCount(both)));
  for (; both != 0u; both &= both - 1u) {
    uint position = uint(findLSB(both));
    items[place++] =
        (rows ? 0u : kEdgeColumns) | ((planes.x >> position & 1u) != 0u ? kEdgeBright : 0u) | own << 5u | position;
  }
}

void set_share(uvec2 pixel, uint side, float share) {
  if (share <= 0.0) return;
  shares[pixel.y * 32u + pixel.x][side] = share;
  atomicOr(has_share[side][pixel.y], 1u << pixel.x);
}

void cut_pixels(uvec2 first, uint edge) {
  bool rows = (edge & kEdgeColumns) == 0u;
  uint line = edge >> 5u & 63u, position = edge & 31u;
  vec2 areas = cut_areas(rows, line + (rows ? first.y : first.x), position + (rows ? first.x : first.y),
                         (edge & kEdgeBright) != 0u);
  uvec2 after = rows ? uvec2(position, line) : uvec2(line, position);
  if (line > 0u) set_share(after - (rows ? uvec2(0u, 1u) : uvec2(1u, 0u)), rows ? 1u : 3u, areas.x);
  if (line < (rows ? kBlockRows : 32u)) set_share(after, rows ? 0u : 2u, areas.y);
}

uint row_mask(uint row) { return has_share[0][row] | has_share[1][row] | has_share[2][row] | has_share[3][row]; }

void list_pixels(uint row) {
  uint mask = row_mask(row), place = atomicAdd(pixel_count, uint(bitCount(mask)));
  for (; mask != 0u; mask &= mask - 1u) items[place++] = row << 5u | uint(findLSB(mask));
}

uint weights_of(uint place) {
  vec4 s = vec4(0.0);
  for (uint n = 0u; n < 4u; ++n)
    if ((has_share[n][place >> 5u] >> (place & 31u) & 1u) != 0u) s[n] = shares[place][n];
  // The pixel is blended along one axis only, that of the greater share. The margin keeps rounding from deciding
  // between equal shares.
  bool vertical = max(s.x, s.y) > max(s.z, s.w) + 1e-4;
  return packUnorm4x8(vec4(vertical ? s.xy : vec2(0.0), vertical ? vec2(0.0) : s.zw));
}

// Adds the rectangle of the pixels with a share in a part of the block.
void add_rectangle(uvec2 first, uvec2 part) {
  uint columns = 0u, rows = 0u, all = 0xFFFFFFFFu >> (32u - uint(GLOAM_BLEND_COLUMNS));
  for (uint i = 0u; i < uint(GLOAM_BLEND_ROWS); ++i) {
    uint mask = row_mask(part.y + i) >> part.x & all;
    columns |= mask;
    rows |= mask != 0u ? 1u << i : 0u;
  }
  if (rows == 0u) return;
  uvec2 low = uvec2(findLSB(columns), findLSB(rows)), high = uvec2(findMSB(columns), findMSB(rows));
  uvec2 corner = first + part + low, size = high - low + 1u;
  rectangles[atomicAdd(blend_command.x, 6u) / 6u] = uvec2(corner.y << 16 | corner.x, size.y << 16 | size.x);
}

void main() {
  uint thread = gl_LocalInvocationIndex;
  uvec2 first = gl_WorkGroupID.xy * uvec2(32u, kBlockRows);
  bool has_row = thread < kBlockRows;
  if (thread == 0u) edge_count = pixel_count = 0u;
  for (uint side = 0u; side < 4u && has_row; ++side) has_share[side][thread] = 0u;
  barrier();
  for (uint line = thread; line < kBlockRows + 34u; line += 32u) list_edges(first, line);
  barrier();
  for (uint i = thread; i < edge_count; i += 32u) cut_pixels(first, items[i]);
  barrier();
  if (has_row) list_pixels(thread);
  barrier();
  for (uint i = thread; i < pixel_count; i += 32u) {
    uvec2 pixel = first + uvec2(items[i] & 31u, items[i] >> 5u);
    weights[pixel.y * c.size.x + pixel.x] = weights_of(items[i]);
  }
  uint row = first.y + thread;
  if (has_row && row < c.size.y) masks[row * ((c.size.x + 31u) / 32u) + gl_WorkGroupID.x] = row_mask(thread);
  const uint parts = 32u / uint(GLOAM_BLEND_COLUMNS);
  if (thread < parts * (kBlockRows / uint(GLOAM_BLEND_ROWS)))
    add_rectangle(first, uvec2(thread % parts * uint(GLOAM_BLEND_COLUMNS), thread / parts * uint(GLOAM_BLEND_ROWS)));
}
