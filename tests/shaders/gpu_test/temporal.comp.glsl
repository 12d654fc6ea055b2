// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// The running mean of noise, for tests of history images: (mean, number of frames, steps of the world, 1).
layout(local_size_x = 8, local_size_y = 8) in;

layout(push_constant, scalar) uniform Constants {
  uint frame;
  uint restart;  // 1: `previous` is not used
};
layout(set = 0, binding = 0) uniform sampler2D previous;
layout(set = 0, binding = 1, rgba32f) writeonly uniform image2D current;
layout(set = 0, binding = 2, scalar) readonly buffer Steps { uint steps; };

uint mixed(uint x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, imageSize(current)))) return;
  float noise = float(mixed(uint(texel.x) + mixed(uint(texel.y) + mixed(frame))) >> 8) / 16777216.0;
  vec2 mean = restart != 0u ? vec2(0.0) : texelFetch(previous, texel, 0).rg;
  float count = mean.g + 1.0;
  imageStore(current, texel, vec4(mean.r + (noise - mean.r) / count, count, float(steps), 1.0));
}
