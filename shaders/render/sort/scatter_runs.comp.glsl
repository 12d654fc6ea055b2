// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/sort/sort_shared.h"

// Moves the values to their sorted places, as count_runs.comp has counted their keys: one column per thread, whose
// array holds the next place of each bin.

layout(local_size_x = GLOAM_SORT_RUN_THREADS) in;
layout(constant_id = 0) const uint kImpliedValues = 0u;  // 1: value i is i

layout(push_constant, scalar) uniform Constants { SortConstants c; };
layout(set = 0, binding = 0, scalar) readonly buffer Keys { uvec4 keys[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Counters { uvec4 counters[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Totals { uvec4 totals[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Values { uint values[]; };
layout(set = 0, binding = 4, scalar) writeonly buffer Sorted { uint sorted_values[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Bins { uint first_of_bin[]; };

void main() {
  uint column = gl_GlobalInvocationID.x;
  uint places[GLOAM_SORT_BINS + 1];  // the last one is of what lies past the last key
  uint first = 0u;
  for (uint quad = 0u; quad < GLOAM_SORT_BINS / 4u; ++quad) {
    uvec4 before = counters[column * (GLOAM_SORT_BINS / 4u) + quad], total = totals[quad];
    for (uint j = 0u; j < 4u; ++j) {
      places[4u * quad + j] = first + before[j];
      if (column == 0u) first_of_bin[4u * quad + j] = first;
      first += total[j];
    }
  }
  if (column == 0u) first_of_bin[GLOAM_SORT_BINS] = first;
  for (uint i = 0u; i < c.column_keys; i += 16u) {
    uint at = column * c.column_keys + i;
    uvec4 words = at < c.count ? keys[at >> 4] : uvec4(0u);
    for (uint j = 0u; j < 16u; ++j) {
      uint key = at + j < c.count ? words[j >> 2] >> (8u * (j & 3u)) & 0xFFu : GLOAM_SORT_BINS;
      uint place = places[key];
      places[key] = place + 1u;
      if (key < GLOAM_SORT_BINS) sorted_values[place] = kImpliedValues != 0u ? at + j : values[at + j];
    }
  }
}
