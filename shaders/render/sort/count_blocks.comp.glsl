// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/sort/sort_shared.h"

// Counts the keys of each column by bin; for devices that run the threads of a workgroup together. Each thread counts
// its own keys in its own counters in shared memory, then sums four bins over all threads.

layout(local_size_x = GLOAM_SORT_BLOCK_THREADS) in;

layout(push_constant, scalar) uniform Constants { SortConstants c; };
layout(set = 0, binding = 0, scalar) readonly buffer Keys { uvec4 keys[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Counters { uvec4 counters[]; };

#include "shaders/render/sort/block.glsl"

void main() {
  uint thread = gl_LocalInvocationIndex;
  count_keys(thread);
  barrier();
  uvec2 sums = uvec2(0u);
  for (uint i = 0u; i < kBlockThreads; ++i)
    sums += uvec2(rows[word_at(2u * thread, i)], rows[word_at(2u * thread + 1u, i)]);
  counters[gl_WorkGroupID.x * (GLOAM_SORT_BINS / 4u) + thread] =
      uvec4(sums.x & 0xFFFFu, sums.x >> 16, sums.y & 0xFFFFu, sums.y >> 16);
}
