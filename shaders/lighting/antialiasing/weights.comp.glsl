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

// A thread for 32 pixels of a row goes through those that may have an edge.
layout(local_size_x = 32) in;

layout(push_constant, scalar) uniform Weights { AntialiasingConstants c; };
layout(set = 0, binding = 0, scalar) readonly buffer EdgeWords { uvec2 edge_words[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Candidates { uint candidates[]; };
// Up, down, left and right of a pixel; only of pixels whose bit in masks is set.
layout(set = 0, binding = 2, scalar) writeonly buffer PixelWeights { uint weights[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Masks { uint masks[]; };

const uint kReach = 32u;  // farthest end of an edge that is found, pixels

// Number of ones in a row downward from bit number count − 1. count: 0…32.
uint ones_below(uint word, uint count) {
  uint zeros = count == 0u ? 0xFFFFFFFFu : ~(word << (32u - count));
  return zeros == 0u ? 32u : 31u - uint(findMSB(zeros));
}
// Number of ones in a row upward from bit 0.
uint ones_above(uint word) { return ~word == 0u ? 32u : uint(findLSB(~word)); }

uint plane(uvec2 planes, bool first) { return first ? planes.x : planes.y; }

// The edge at a position of a line, in both planes. position: −1 to the line's length.
uvec2 edge_at(bool rows, uint line, uint position) {
  uint bit = position + 32u;
  return (edge_words[first_word(rows, c.size, line) + bit / 32u] >> (bit % 32u)) & 1u;
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
  uint at = first_word(rows, c.size, line) + position / 32u + 1u, bit = position % 32u;
  uint own = plane(edge_words[at], before_is_brighter);
  uint back = ones_below(own, bit), forth = ones_above(own >> bit) - 1u;
  if (back == bit) back += ones_below(plane(edge_words[at - 1u], before_is_brighter), 32u);
  if (bit + forth == 31u) forth += ones_above(plane(edge_words[at + 1u], before_is_brighter));

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

uint weights_of(uvec2 pixel) {
  // Bit n: there is an edge in direction n, and bit n + 4: the pixel before it is the brighter one.
  uint edges = 0u;
  for (uint n = 0u; n < 4u; ++n) {
    bool rows = n < 2u;
    uvec2 planes = edge_at(rows, (rows ? pixel.y : pixel.x) + (n & 1u), rows ? pixel.x : pixel.y);
    edges |= (planes.x | planes.y) << n | planes.x << (n + 4u);
  }
  vec4 shares = vec4(0.0);
  for (uint n = 0u; n < 4u && edges != 0u; ++n) {
    if ((edges >> n & 1u) == 0u) continue;
    bool rows = n < 2u;
    vec2 areas = cut_areas(rows, (rows ? pixel.y : pixel.x) + (n & 1u), rows ? pixel.x : pixel.y,
                           (edges >> (n + 4u) & 1u) != 0u);
    shares[n] = (n & 1u) != 0u ? areas.x : areas.y;
  }
  // The pixel is blended along one axis only, that of the greater share. The margin keeps rounding from deciding
  // between equal shares.
  bool vertical = max(shares.x, shares.y) > max(shares.z, shares.w) + 1e-4;
  return packUnorm4x8(vec4(vertical ? shares.xy : vec2(0.0), vertical ? vec2(0.0) : shares.zw));
}

void main() {
  uint row = gl_GlobalInvocationID.x, word = gl_GlobalInvocationID.y, words = line_words(c.size.x) - 2u;
  if (row >= c.size.y || word >= words) return;
  uint at = row * words + word;
  uvec2 above = edge_words[first_word(true, c.size, row) + word + 1u];
  uvec2 below = edge_words[first_word(true, c.size, row + 1u) + word + 1u];
  uint left = candidates[at], next = word + 1u < words ? candidates[at + 1u] << 31u : 0u;
  uint mask = above.x | above.y | below.x | below.y | left | left >> 1u | next;
  masks[at] = mask;
  for (; mask != 0u; mask &= mask - 1u) {
    uint column = word * 32u + uint(findLSB(mask));
    weights[row * c.size.x + column] = weights_of(uvec2(column, row));
  }
}
