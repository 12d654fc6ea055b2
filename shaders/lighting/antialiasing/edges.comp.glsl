// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/antialiasing/edge_bits.glsl"
#include "shaders/lighting/lighting_shared.h"

// Finds the edges of a picture along rows and columns (edge_bits.glsl). A workgroup has a square of 32 × 32 pixels, and
// a thread one word of a row's line and one of a column's. An edge is a step of brightness that is not beside a
// parallel step more than twice as high (Jimenez et al. 2012, "SMAA: Enhanced Subpixel Morphological Antialiasing",
// section 3.1). Numbers that are not finite make no edge.

layout(local_size_x = 32) in;

layout(push_constant, scalar) uniform Edges { AntialiasingConstants c; };
layout(set = 0, binding = 0) uniform sampler2D shown_image;  // brightness in alpha
layout(set = 0, binding = 1, scalar) writeonly buffer EdgeWords { uvec2 edge_words[]; };
// The draw of blend.vert.glsl, which weights.comp.glsl fills.
layout(set = 0, binding = 2, scalar) writeonly buffer BlendCommand { uvec4 blend_command; };

const float kThreshold = 0.05;

// Brightness of the square, with two pixels before it and one behind it. A pixel is read by up to eight edges, and
// shared memory costs less than an image.
const int kSide = 35;
shared float brightness[kSide * kSide];

void read_square(ivec2 first, int thread) {
  for (int i = thread; i < kSide * kSide; i += 32) {
    ivec2 pixel = clamp(first + ivec2(i % kSide, i / kSide) - 2, ivec2(0), ivec2(c.size) - 1);
    brightness[i] = texelFetch(shown_image, pixel, 0).a;
  }
}

// The edges of a word. at: place in brightness of the first pixel behind the line; along, across: steps from it to the
// next pixel and to the next line.
uvec2 find_edges(int at, int along, int across, uint count) {
  uvec2 bits = uvec2(0u);
  for (uint i = 0u; i < count; ++i) {
    float own = brightness[at], before = brightness[at - across];
    float rise = before - own;  // 0 in the first line
    float above = abs(brightness[at - 2 * across] - before), below = abs(own - brightness[at + across]);
    bool edge = abs(rise) >= kThreshold && !(max(above, below) > 2.0 * abs(rise));
    uint bit = 1u << i;
    bits.x |= edge && rise > 0.0 ? bit : 0u;
    bits.y |= edge && rise < 0.0 ? bit : 0u;
    at += along;
  }
  return bits;
}

// Stores the word of a line, and the empty words at the line's ends beside it.
void store(bool rows, uint line, uint word, uvec2 bits) {
  uint first = first_word(rows, c.size, line), last = line_words(rows ? c.size.x : c.size.y) - 1u;
  edge_words[first + word + 1u] = bits;
  if (word == 0u) edge_words[first] = uvec2(0u);
  if (word + 2u == last) edge_words[first + last] = uvec2(0u);
}

void main() {
  uint thread = gl_LocalInvocationIndex;
  uvec2 square = gl_WorkGroupID.xy, first = square * 32u, line = first + thread, words = (c.size + 31u) / 32u;
  if (square == uvec2(0u) && thread == 0u) blend_command = uvec4(0u, 1u, 0u, 0u);
  read_square(ivec2(first), int(thread));
  barrier();
  uvec2 count = min(max(c.size, first) - first, uvec2(32u));
  uvec2 row_bits = find_edges((int(thread) + 2) * kSide + 2, 1, kSide, line.y < c.size.y ? count.x : 0u);
  uvec2 column_bits = find_edges(2 * kSide + int(thread) + 2, kSide, 1, line.x < c.size.x ? count.y : 0u);
  if (line.y <= c.size.y && square.x < words.x) store(true, line.y, square.x, row_bits);
  if (line.x <= c.size.x && square.y < words.y) store(false, line.x, square.y, column_bits);
}
