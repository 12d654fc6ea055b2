// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Loops, exits, functions and conditional values that specialisation constants switch on and off.
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint kMode = 0u;
layout(constant_id = 1) const bool kTwice = false;
layout(constant_id = 2) const int kSteps = 3;
layout(constant_id = 3) const float kFactor = 1.5;

layout(set = 0, binding = 0, scalar) readonly buffer Source { uint source[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Target { uint target[]; };

// Several returns: the function stays a call.
uint steps_to_one(uint v) {
  for (uint steps = 0u; steps < 200u; ++steps) {
    if (v < 2u) return steps;
    v = v % 2u == 0u ? v / 2u : 3u * v + 1u;
  }
  return 999u;
}

void main() {
  uint i = gl_GlobalInvocationID.x, v = source[i], sum = 0u;
  for (int step = 0; step < kSteps; ++step) {
    sum += v + uint(step);
    if (kMode == 1u && sum > 50u) break;
    if (kMode == 2u) continue;
    sum ^= 5u;
  }
  for (;;) {  // ends in its first round if kMode is 3
    ++sum;
    if (kMode == 3u) break;
    if (sum % 7u == 0u) break;
  }
  if (kMode == 4u) {
    if (v % 2u == 0u) {
      sum += steps_to_one(v);
    } else {
      sum += 3u;
    }
  }
  for (int step = 0; kMode == 5u && step < int(v % 4u); ++step) sum = sum * 3u + 1u;
  sum = kTwice ? sum * 2u : sum;
  const uint last = kMode > 2u && kTwice ? sum + 1u : sum;
  target[i] = last + uint(float(v) * kFactor);
}
