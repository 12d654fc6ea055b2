// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/culling/culling_shared.h"

// The finest image of occluder depth: the farthest depth of 8x8 pixels, sky included (reversed Z: the least value).
// Texels beyond the picture hide everything.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D depth_image;
layout(set = 0, binding = 1, r32f) uniform writeonly image2D farthest_image;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(farthest_image)))) return;
  ivec2 size = textureSize(depth_image, 0);
  float farthest = 1.0;
  const int side = int(GLOAM_CULLING_TEXEL) / 2;
  for (int i = 0; i < side * side; ++i) {
    // The corner that four pixels share. Where they exceed the picture, the sampler repeats its border.
    vec2 corner = vec2(texel * 2 * side + ivec2(i % side, i / side) * 2 + 1);
    vec4 d = textureGather(depth_image, corner / vec2(size));
    farthest = min(farthest, min(min(d.x, d.y), min(d.z, d.w)));
  }
  bool beyond = any(greaterThanEqual(texel * 2 * side, size));
  imageStore(farthest_image, texel, vec4(beyond ? 1.0 : farthest));
}
