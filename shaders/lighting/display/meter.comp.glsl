// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/lighting_shared.h"

// Automatic exposure of one view. A histogram of log2 luminance counts a grid of 32×32 pixels in bins of a quarter of a
// stop. The darkest tenth and the brightest twentieth count for nothing, such as a lamp in a corner; of the rest the
// mean is taken. Then the key value of Krawczyk et al. 2005, which keeps night darker than day. So that the exposure
// follows the light without steps, a pixel counts in two bins by its distance from their middles, and a bin's pixels
// count as if they filled its width evenly. Sums are integers: the result does not depend on the order of threads.
//
// Black pixels count for nothing either, such as the background of a scene without a sky, and what no light reaches:
// the exposure is that of what is lit. If fewer than kFewest pixels of the grid are lit, a grid of 256×256 is metered,
// so that small lamps are found.

const uint kThreads = 256u;
const uint kFewest = 32u;
const uint kWhole = 256u;  // count of a pixel
const float kBinsPerStop = 4.0;
const float kFirstStop = -13.287712;  // log2(1e-4): a dark picture must not get an unbounded exposure
const uint kBins = 454u;              // up to 1e30 cd/m²
const float kDarkest = 0.1, kBrightest = 0.05;

layout(local_size_x = 256) in;

layout(push_constant, scalar) uniform Meter { MeterConstants c; };
layout(set = 0, binding = 0) uniform sampler2D lit_image;
layout(set = 0, binding = 1, scalar) buffer Exposure { MeteredExposure metered; };

shared uint counts[kBins];
shared uint lit_pixels;

// Counts this thread's pixels of a grid of side × side.
void count_pixels(uint side) {
  for (uint i = gl_LocalInvocationIndex; i < side * side; i += kThreads) {
    uvec2 pixel = (uvec2(i % side, i / side) * 2u + 1u) * c.size / (2u * side);
    vec3 light = texelFetch(lit_image, ivec2(pixel), 0).rgb;
    float luminance = dot(light, vec3(0.2126, 0.7152, 0.0722)) * c.inverse_scale;
    if (!(luminance > 0.0)) continue;
    float at = (log2(clamp(luminance, 1e-4, 1e30)) - kFirstStop) * kBinsPerStop;
    uint bin = min(uint(max(at, 0.0)), kBins - 2u);
    uint share = uint(clamp(at - float(bin), 0.0, 1.0) * float(kWhole) + 0.5);
    atomicAdd(counts[bin], kWhole - share);
    atomicAdd(counts[bin + 1u], share);
    atomicAdd(lit_pixels, 1u);
  }
}

// Mean of log2 luminance between the two percentiles. There is a lit pixel.
float trimmed_mean() {
  float total = float(lit_pixels) * float(kWhole);
  float from = kDarkest * total, to = (1.0 - kBrightest) * total, below = 0.0, sum = 0.0;
  for (uint i = 0u; i < kBins; ++i) {
    float count = float(counts[i]), first = max(from - below, 0.0), last = min(to - below, count);
    if (last > first) sum += (last - first) * (float(i) - 0.5 + 0.5 * (first + last) / count);
    below += count;
  }
  return kFirstStop + sum / (to - from) / kBinsPerStop;
}

void main() {
  uint thread = gl_LocalInvocationIndex;
  for (uint i = thread; i < kBins; i += kThreads) counts[i] = 0u;
  if (thread == 0u) lit_pixels = 0u;
  barrier();
  count_pixels(32u);
  barrier();
  bool few = lit_pixels < kFewest;
  barrier();
  if (few) {
    for (uint i = thread; i < kBins; i += kThreads) counts[i] = 0u;
    if (thread == 0u) lit_pixels = 0u;
  }
  barrier();
  if (few) count_pixels(256u);
  barrier();
  if (thread != 0u) return;
  float mean = lit_pixels != 0u ? exp2(trimmed_mean()) : 1e-4;
  float key = 1.03 - 2.0 / (2.0 + log2(mean + 1.0) / log2(10.0));
  float right = key / mean;
  if (c.begins == 0u) {
    float last = metered.exposure;
    float share = metered.frame == c.frame ? 0.0 : (right < last ? c.to_bright : c.to_dark);
    right = last * exp2(log2(right / last) * share);
  }
  metered.exposure = right;
  metered.frame = c.frame;
}
