// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/sort/sort_shared.h"

// Moves the values to their sorted places, as count_blocks.comp has counted their keys. The block's keys are counted
// again. The counters of a bin then become the numbers of its keys in the threads before; a thread's counter is the
// place of its next key among the block's.

layout(local_size_x = GLOAM_SORT_BLOCK_THREADS) in;
layout(constant_id = 0) const uint kImpliedValues = 0u;  // 1: value i is i

layout(push_constant, scalar) uniform Constants { SortConstants c; };
layout(set = 0, binding = 0, scalar) readonly buffer Keys { uvec4 keys[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Counters { uint counters[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Bins { uint first_of_bin[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Values { uint values[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Sorted { uint sorted_values[]; };

#include "shaders/render/sort/block.glsl"

void scan_row(uint row) {
  uint before = 0u;
  for (uint i = 0u; i < kBlockThreads; ++i) {
    uint word = word_at(row, i);
    uint counted = rows[word];
    rows[word] = before;
    before += counted;  // no carry: a column has at most 4,096 keys
  }
}

void main() {
  uint thread = gl_LocalInvocationIndex;
  count_keys(thread);
  barrier();
  scan_row(2u * thread);
  scan_row(2u * thread + 1u);
  barrier();
  for (uint i = 0u; i < GLOAM_SORT_THREAD_KEYS; i += 16u) {
    uint at = first_key(thread) + i;
    uvec4 words = keys_from(at);
    for (uint j = 0u; j < 16u; ++j) {
      if (at + j >= c.count) break;
      uint key = key_of(words, j);
      uint word = word_at(key >> 1, thread), shift = 16u * (key & 1u);
      uint place =
          first_of_bin[key] + counters[gl_WorkGroupID.x * GLOAM_SORT_BINS + key] + (rows[word] >> shift & 0xFFFFu);
      rows[word] += 1u << shift;
      sorted_values[place] = kImpliedValues != 0u ? at + j : values[at + j];
    }
  }
}
