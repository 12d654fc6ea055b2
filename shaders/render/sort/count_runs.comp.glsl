// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/sort/sort_shared.h"

// Counts the keys of each column by bin; for devices that run the threads of a workgroup in turn. Each thread counts
// the run of one column in an array of its own: lavapipe reads and writes such an array of all lanes without a loop,
// unlike shared memory and buffers, and there is no barrier.

layout(local_size_x = GLOAM_SORT_RUN_THREADS) in;

layout(push_constant, scalar) uniform Constants { SortConstants c; };
layout(set = 0, binding = 0, scalar) readonly buffer Keys { uvec4 keys[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Counters { uvec4 counters[]; };

void main() {
  uint column = gl_GlobalInvocationID.x;
  uint bins[GLOAM_SORT_BINS + 1];  // the last one takes what lies past the last key
  for (uint bin = 0u; bin < GLOAM_SORT_BINS; ++bin) bins[bin] = 0u;
  for (uint i = 0u; i < c.column_keys; i += 16u) {
    uint at = column * c.column_keys + i;
    uvec4 words = at < c.count ? keys[at >> 4] : uvec4(0u);
    for (uint j = 0u; j < 16u; ++j) {
      uint key = at + j < c.count ? words[j >> 2] >> (8u * (j & 3u)) & 0xFFu : GLOAM_SORT_BINS;
      ++bins[key];
    }
  }
  for (uint quad = 0u; quad < GLOAM_SORT_BINS / 4u; ++quad) {
    uint bin = 4u * quad;
    counters[column * (GLOAM_SORT_BINS / 4u) + quad] = uvec4(bins[bin], bins[bin + 1u], bins[bin + 2u], bins[bin + 3u]);
  }
}
