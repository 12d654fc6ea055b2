// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Filters one mip from the next larger mip of the same image.
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D above;
layout(set = 0, binding = 1, r32f) writeonly uniform image2D below;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  ivec2 size = imageSize(below);
  if (any(greaterThanEqual(texel, size))) return;
  imageStore(below, texel, textureLod(above, (vec2(texel) + 0.5) / vec2(size), 0.0));
}
