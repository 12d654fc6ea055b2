// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Adds depth to the contents of two storage images of one channel, which are read and written.
layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D depth;
layout(set = 0, binding = 1, r32f) uniform image2D exact;
layout(set = 0, binding = 2, r16) uniform image2D rounded;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(exact)))) return;
  float added = texelFetch(depth, texel, 0).r;
  imageStore(exact, texel, vec4(imageLoad(exact, texel).r + added));
  imageStore(rounded, texel, vec4(imageLoad(rounded, texel).r + added));
}
