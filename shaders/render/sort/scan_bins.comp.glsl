// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/sort/sort_shared.h"

// The exclusive prefix sum of the bins' totals: the first place of each bin, then the number of keys. One workgroup;
// scatter_runs.comp does this by itself.

layout(local_size_x = GLOAM_SORT_BLOCK_THREADS) in;

layout(set = 0, binding = 0, scalar) readonly buffer Totals { uint totals[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Bins { uint first_of_bin[]; };

const uint kThreads = GLOAM_SORT_BLOCK_THREADS;
shared uint sums[GLOAM_SORT_BLOCK_THREADS];

void main() {
  uint thread = gl_LocalInvocationIndex;
  uint share = GLOAM_SORT_BINS / kThreads, first = thread * share;
  uint sum = 0u;
  for (uint i = 0u; i < share; ++i) sum += totals[first + i];
  sums[thread] = sum;
  barrier();
  uint before = 0u;
  for (uint i = 0u; i < kThreads; ++i) before += i < thread ? sums[i] : 0u;
  for (uint i = 0u; i < share; ++i) {
    first_of_bin[first + i] = before;
    before += totals[first + i];
  }
  if (thread == kThreads - 1u) first_of_bin[GLOAM_SORT_BINS] = before;
}
