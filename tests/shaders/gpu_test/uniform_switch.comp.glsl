// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) uniform Numbers { uint number; };
layout(set = 0, binding = 1, scalar) buffer Target { uint target[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  switch (number) {
    case 1u:
      target[i] += 3u;
      break;
    case 5u:
      target[i] *= 7u;
      break;
    default:
      target[i] ^= 3u;
  }
}
