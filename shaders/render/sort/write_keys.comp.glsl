// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/sort/sort_shared.h"

// Writes the sorted keys, a word of four per thread. The key at a place is the last bin that begins at or before it.

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Constants { SortConstants c; };
layout(set = 0, binding = 0, scalar) readonly buffer Bins { uint first_of_bin[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer SortedKeys { uint sorted_keys[]; };

uint key_at(uint place) {
  uint key = 0u;
  for (uint half_range = GLOAM_SORT_BINS / 2u; half_range > 0u; half_range >>= 1)
    key += first_of_bin[key + half_range] <= place ? half_range : 0u;
  return key;
}

void main() {
  uint word = gl_GlobalInvocationID.x;
  if (4u * word >= c.count) return;
  uint packed = 0u;
  for (uint j = 0u; j < 4u; ++j) packed |= (4u * word + j < c.count ? key_at(4u * word + j) : 0u) << (8u * j);
  sorted_keys[word] = packed;
}
