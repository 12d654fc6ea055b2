// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Writes x + 10 y + 100 z to each texel of a volume.
layout(local_size_x = 4, local_size_y = 4, local_size_z = 4) in;

layout(set = 0, binding = 0, r32f) writeonly uniform image3D target;

void main() {
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  if (any(greaterThanEqual(texel, imageSize(target)))) return;
  imageStore(target, texel, vec4(float(texel.x + 10 * texel.y + 100 * texel.z)));
}
