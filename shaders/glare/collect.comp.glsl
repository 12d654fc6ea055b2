// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/glare/glare_shared.h"

// Collects the light of a picture in square cells. Each pixel's light goes to the four cells whose centres surround the
// pixel's centre, by bilinear weights: so each pixel gives the same light, and its centre is kept. A thread takes the
// pixels between the centres of four cells, each pixel once, and writes a part of the light of each of the four
// (join.comp). Light that is not a number counts as none, and infinite light as GLOAM_GLARE_MOST_LIGHT.

layout(constant_id = 0) const int kMostPixels = 0;  // GlareCollect::most_pixels, or 0: known at run time only

layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Collect { GlareCollect c; };
layout(set = 0, binding = 0) uniform sampler2D lit_image;
layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D parts_image;

// Bits are compared, because compilers may assume that comparisons of floats never see NaN.
vec3 collected(vec3 light) {
  bvec3 is_nan = greaterThan(floatBitsToUint(light) & 0x7FFFFFFFu, uvec3(0x7F800000u));
  return mix(clamp(light, vec3(0.0), vec3(GLOAM_GLARE_MOST_LIGHT)), vec3(0.0), is_nan);
}

// The first pixel whose centre is at or after these positions, which are counted in cells from the first corner.
ivec2 first_pixel(vec2 cells) { return ivec2(ceil(c.origin + cells * c.cell - 0.5)); }

// Adds up the parts of the four cells around a corner, from the left to the right and from the top. most: pixels along
// a side; loops of a known length are faster.
void add_parts(ivec2 first, ivec2 end, vec2 start, int most, out vec3 sums[4]) {
  float inverse_cell = 1.0 / c.cell;
  sums = vec3[4](vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  for (int y = 0; y < most; ++y) {
    int row = first.y + y;
    float down = (float(row) + 0.5 - c.origin.y) * inverse_cell - start.y;
    vec3 left = vec3(0.0), right = vec3(0.0);
    for (int x = 0; x < most; ++x) {
      int column = first.x + x;
      vec3 light = texelFetch(lit_image, min(ivec2(column, row), c.size - 1), 0).rgb;
      float across = (float(column) + 0.5 - c.origin.x) * inverse_cell - start.x;
      light = column < end.x ? collected(light) : vec3(0.0);
      left += light * (1.0 - across);
      right += light * across;
    }
    down = row < end.y ? down : 0.0;
    float up = row < end.y ? 1.0 - down : 0.0;
    sums[0] += left * up;
    sums[1] += right * up;
    sums[2] += left * down;
    sums[3] += right * down;
  }
}

void main() {
  ivec2 corner = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(corner, c.corners))) return;
  vec2 start = vec2(corner) - 0.5;
  ivec2 first = max(first_pixel(start), ivec2(0)), end = min(first_pixel(start + 1.0), c.size);
  vec3 sums[4];
  if (kMostPixels != 0)
    add_parts(first, end, start, kMostPixels, sums);
  else
    add_parts(first, end, start, c.most_pixels, sums);
  float share = 1.0 / (c.cell * c.cell);
  for (int i = 0; i < 4; ++i)
    imageStore(parts_image, 2 * corner + ivec2(i & 1, i >> 1),
               vec4(min(sums[i] * share, vec3(GLOAM_GLARE_MOST_LIGHT)), 1.0));
}
