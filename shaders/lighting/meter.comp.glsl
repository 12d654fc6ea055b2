// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/lighting_shared.h"

// Automatic exposure of one view: the mean of log2 luminance over a grid of 32×32 pixels, summed in a fixed order so
// that the result does not depend on the subgroup size. Then the key value of Krawczyk et al. 2005, which keeps night
// darker than day.

layout(local_size_x = 32) in;

layout(push_constant, scalar) uniform Meter { MeterConstants c; };
layout(set = 0, binding = 0) uniform sampler2D lit_image;
layout(set = 0, binding = 1, scalar) buffer Exposure { float exposure; };

shared float sums[32];

void main() {
  uint row = gl_LocalInvocationIndex;
  float sum = 0.0;
  for (uint column = 0u; column < 32u; ++column) {
    uvec2 pixel = (uvec2(column, row) * 2u + 1u) * c.size / 64u;
    vec3 light = texelFetch(lit_image, ivec2(pixel), 0).rgb;
    float luminance = dot(light, vec3(0.2126, 0.7152, 0.0722));
    sum += log2(clamp(luminance, 1e-4, 1e6));  // lower limit: a black picture must not get an unbounded exposure
  }
  sums[row] = sum;
  barrier();
  if (row != 0u) return;
  float total = 0.0;
  for (uint i = 0u; i < 32u; ++i) total += sums[i];
  float mean = exp2(total / 1024.0);
  float key = 1.03 - 2.0 / (2.0 + log2(mean + 1.0) / log2(10.0));
  exposure = key / mean;
}
