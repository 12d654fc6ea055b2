// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/lighting_shared.h"

// Automatic exposure of one view: the mean of log2 luminance over a grid of 32×32 pixels, summed in a fixed order so
// that the result does not depend on the subgroup size. Then the key value of Krawczyk et al. 2005, which keeps night
// darker than day.
//
// Black pixels count for nothing, such as the background of a scene without a sky, and what no light reaches: the
// exposure is that of what is lit. If fewer than kFewest pixels of the grid are lit, a grid of 256×256 is metered, so
// that small lamps are found.

const uint kRows = 32u;  // a thread each
const uint kFewest = 32u;

layout(local_size_x = 32) in;

layout(push_constant, scalar) uniform Meter { MeterConstants c; };
layout(set = 0, binding = 0) uniform sampler2D lit_image;
layout(set = 0, binding = 1, scalar) buffer Exposure { float exposure; };

shared float sums[kRows];
shared uint counts[kRows];

// Adds up a row of a grid of side × side pixels.
void add_row(uint row, uint side, inout float sum, inout uint count) {
  for (uint column = 0u; column < side; ++column) {
    uvec2 pixel = (uvec2(column, row) * 2u + 1u) * c.size / (2u * side);
    vec3 light = texelFetch(lit_image, ivec2(pixel), 0).rgb;
    float luminance = dot(light, vec3(0.2126, 0.7152, 0.0722)) * c.inverse_scale;
    if (!(luminance > 0.0)) continue;
    sum += log2(clamp(luminance, 1e-4, 1e30));  // lower limit: a dark picture must not get an unbounded exposure
    ++count;
  }
}

void main() {
  uint thread = gl_LocalInvocationIndex;
  float sum = 0.0;
  uint count = 0u;
  add_row(thread, kRows, sum, count);
  sums[thread] = sum;
  counts[thread] = count;
  barrier();
  uint lit = 0u;
  for (uint i = 0u; i < kRows; ++i) lit += counts[i];
  barrier();
  if (lit < kFewest) {
    sum = 0.0;
    count = 0u;
    for (uint row = thread; row < 8u * kRows; row += kRows) add_row(row, 8u * kRows, sum, count);
    sums[thread] = sum;
    counts[thread] = count;
  }
  barrier();
  if (thread != 0u) return;
  float total = 0.0;
  lit = 0u;
  for (uint i = 0u; i < kRows; ++i) {
    total += sums[i];
    lit += counts[i];
  }
  float mean = lit != 0u ? exp2(total / float(lit)) : 1e-4;
  float key = 1.03 - 2.0 / (2.0 + log2(mean + 1.0) / log2(10.0));
  exposure = key / mean;
}
