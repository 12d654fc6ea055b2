// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_Z_BINS_API_GLSL
#define GLOAM_SHADERS_LIGHTS_Z_BINS_API_GLSL

#include "shaders/lights/lights_shared.h"

// Access to the zBins: sorted lights by view depth, as modules/lights/bins/z_bins.h builds them. Before including this,
// define GLOAM_Z_BINS_BINDING.

layout(set = 0, binding = GLOAM_Z_BINS_BINDING, scalar) readonly buffer ZBinWords { uint z_bin_words[]; };

uint z_bin_of(LightGrid grid, float depth_m) {
  return uint(clamp((depth_m - grid.z_near) * grid.z_scale, 0.0, float(grid.z_bin_count - 1u)));
}

// The sorted lights [x, y) that may touch view depths between nearest_m and farthest_m; none when x >= y. Uses the
// standard set for one bin or two neighbouring bins, otherwise the ranged set: its first bin has the lesser begin, its
// last bin the greater end, so the min and max below fit both sets.
uvec2 z_bin_range(LightGrid grid, float nearest_m, float farthest_m) {
  uint first = z_bin_of(grid, nearest_m);
  uint last = z_bin_of(grid, farthest_m);
  uint set = last - first <= 1u ? 0u : grid.z_bin_count;
  uint a = z_bin_words[set + first];
  uint b = z_bin_words[set + last];
  return uvec2(min(a & 0xFFFFu, b & 0xFFFFu), max(a >> 16, b >> 16));
}

// The bits of one mask word (32 lights) that lie in [range.x, range.y).
uint z_bin_bits(uvec2 range, uint word) {
  int low = clamp(int(range.x) - int(word * 32u), 0, 32);
  int high = clamp(int(range.y) - int(word * 32u), 0, 32);
  if (low >= high) return 0u;
  return (0xFFFFFFFFu << low) & (0xFFFFFFFFu >> (32 - high));
}

#endif
