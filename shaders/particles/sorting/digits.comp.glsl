// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/prelude.h"

// Packs eight bits of each key for the radix sort, four keys a word: of the keys in their own order, or in the order
// that a first pass has found.

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kShift = 0u;
layout(constant_id = 1) const uint kOrdered = 0u;  // 1: in the order of `order`

layout(push_constant, scalar) uniform Count { uint count; };  // of keys; a multiple of 4
layout(set = 0, binding = 0, scalar) readonly buffer Keys { uint keys[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Order { uint order[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Digits { uint digits[]; };

void main() {
  uint first = 4u * gl_GlobalInvocationID.x;
  if (first >= count) return;
  uint word = 0u;
  for (uint i = 0u; i < 4u; ++i) {
    uint key = kOrdered != 0u ? keys[order[first + i]] : keys[first + i];
    word |= ((key >> kShift) & 0xFFu) << (8u * i);
  }
  digits[gl_GlobalInvocationID.x] = word;
}
