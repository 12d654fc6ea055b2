// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/lighting_shared.h"

// Finds the edges of a picture along rows or columns, a thread for each word of 32 pixels (edge_bits.glsl). An edge is
// a step of brightness that is not beside a parallel step more than twice as high (Jimenez et al. 2012, "SMAA: Enhanced
// Subpixel Morphological Antialiasing", section 3.1). Numbers that are not finite make no edge.

layout(local_size_x = 32) in;

layout(constant_id = 0) const uint kRows = 0u;  // 1: of rows, with the candidates

layout(push_constant, scalar) uniform Edges { EdgeConstants c; };
layout(set = 0, binding = 0) uniform sampler2D shown_image;  // brightness in alpha
layout(set = 0, binding = 1, scalar) writeonly buffer EdgeWords { uvec2 edge_words[]; };
// A bit for each pixel that differs enough from its left neighbour, 32 pixels of a row in a word.
layout(set = 0, binding = 2, scalar) writeonly buffer Candidates { uint candidates[]; };

const float kThreshold = 0.05;

float brightness(int line, int position) {
  int inside = clamp(line, 0, int(c.lines) - 2);
  return texelFetch(shown_image, inside * c.across + position * c.along, 0).a;
}

void main() {
  uint line = gl_GlobalInvocationID.x, word = gl_GlobalInvocationID.y;
  if (line >= c.lines || word >= c.words) return;
  bool empty = line == c.lines - 1u || word == 0u || word == c.words - 1u;
  int first = int(word) * 32 - 32, n = int(line);
  int count = empty ? 0 : min(32, int(c.pixels) - first);
  uvec2 bits = uvec2(0u);
  uint differ = 0u;
  float last = brightness(n, max(first - 1, 0));
  for (int i = 0; i < count; ++i) {
    float own = brightness(n, first + i);
    float rise = brightness(n - 1, first + i) - own;  // 0 in the first line
    bool edge = abs(rise) >= kThreshold;
    if (edge) {
      float above = abs(brightness(n - 2, first + i) - brightness(n - 1, first + i));
      float below = abs(own - brightness(n + 1, first + i));
      edge = !(max(above, below) > 2.0 * abs(rise));
    }
    uint bit = 1u << i;
    bits.x |= edge && rise > 0.0 ? bit : 0u;
    bits.y |= edge && rise < 0.0 ? bit : 0u;
    if (kRows != 0u) {
      differ |= abs(own - last) >= kThreshold ? bit : 0u;
      last = own;
    }
  }
  edge_words[c.first + line * c.words + word] = bits;
  if (kRows != 0u && !empty) candidates[line * (c.words - 2u) + word - 1u] = differ;
}
