// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/sort/sort_shared.h"

// Replaces each counter by the sum of its bin's counters in the columns before, and writes the sums over all columns.
// One workgroup per four bins; each thread scans a contiguous range of columns.

layout(local_size_x = GLOAM_SORT_BLOCK_THREADS) in;

layout(push_constant, scalar) uniform Constants { SortConstants c; };
layout(set = 0, binding = 0, scalar) buffer Counters { uvec4 counters[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Totals { uvec4 totals[]; };

const uint kThreads = GLOAM_SORT_BLOCK_THREADS;
shared uvec4 sums[GLOAM_SORT_BLOCK_THREADS];

void main() {
  uint thread = gl_LocalInvocationIndex, quad = gl_WorkGroupID.x;
  // All threads take the same turns; columns past the last count 0 (see blur_tiles.comp).
  uint share = (c.columns + kThreads - 1u) / kThreads, first = thread * share;
  uvec4 sum = uvec4(0u);
  for (uint i = 0u; i < share; ++i)
    sum += first + i < c.columns ? counters[(first + i) * (GLOAM_SORT_BINS / 4u) + quad] : uvec4(0u);
  sums[thread] = sum;
  barrier();
  uvec4 before = uvec4(0u);
  for (uint i = 0u; i < kThreads; ++i) before += i < thread ? sums[i] : uvec4(0u);
  if (thread == kThreads - 1u) totals[quad] = before + sum;
  for (uint i = 0u; i < share; ++i) {
    bool exists = first + i < c.columns;
    uint at = (first + i) * (GLOAM_SORT_BINS / 4u) + quad;
    uvec4 counted = exists ? counters[at] : uvec4(0u);
    if (exists) counters[at] = before;
    before += counted;
  }
}
