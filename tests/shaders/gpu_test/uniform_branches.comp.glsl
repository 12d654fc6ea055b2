// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Branches of one kind each, chosen by a specialisation constant.
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kKind = 0u;

layout(set = 0, binding = 0, scalar) uniform Numbers {
  uint number;
  uint elements[4];
};
layout(set = 0, binding = 1, scalar) readonly buffer Source { uint source[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Target { uint target[]; };
layout(push_constant, scalar) uniform Pushed { uint pushed; };

// Several returns: the function stays a call.
uint halvings(uint v) {
  for (uint count = 0u; count < 40u; ++count) {
    if (v < 2u) return count;
    v /= 2u;
  }
  return 40u;
}

void main() {
  uint i = gl_GlobalInvocationID.x, v = source[i], sum = v;
  if (kKind == 0u && number > 3u) sum += halvings(v);
  if (kKind == 1u && pushed > 3u) sum += halvings(v);
  if (kKind == 2u) {
    for (uint k = 0u; k < number; ++k) sum = sum * 3u + k + v % 5u;
  }
  if (kKind == 3u) sum += halvings(number);
  if (kKind == 4u) {
    uint chosen = 5u;
    if (number > 3u) chosen = v > 7u ? 6u : 7u;
    sum += chosen;
    bool known = number > 3u && pushed > 1u;
    if (known) sum += halvings(v);
  }
  // No uniform alone decides these.
  if (kKind == 5u && v > 3u) sum += halvings(v);
  if (kKind == 6u) {
    for (uint k = 0u; k < 4u; ++k) sum = sum * 3u + elements[k];
  }
  if (kKind == 7u && elements[v % 4u] > 3u) sum += halvings(v);
  target[i] = sum;
}
