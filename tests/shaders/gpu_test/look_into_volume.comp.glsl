// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Samples a volume at the given positions.
layout(local_size_x = 64) in;

layout(set = 0, binding = 0) uniform sampler3D volume;
layout(set = 0, binding = 1, scalar) readonly buffer Positions { vec3 positions[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Seen { float seen[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i < uint(positions.length())) seen[i] = textureLod(volume, positions[i], 0.0).x;
}
