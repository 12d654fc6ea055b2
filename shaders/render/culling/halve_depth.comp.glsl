// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// A coarser image of occluder depth: the farthest of 2x2 texels of the one before. The sides are powers of two.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D finer_image;
layout(set = 0, binding = 1, r32f) uniform writeonly image2D coarser_image;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(coarser_image)))) return;
  ivec2 last = textureSize(finer_image, 0) - 1, from = 2 * texel;
  float farthest = 1.0;
  for (int i = 0; i < 4; ++i)
    farthest = min(farthest, texelFetch(finer_image, min(from + ivec2(i & 1, i >> 1), last), 0).r);
  imageStore(coarser_image, texel, vec4(farthest));
}
