// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/veil/veil_shared.h"

// The mean light of a captured image, averaged over frames.

layout(local_size_x = 1) in;
layout(push_constant, scalar) uniform Average { VeilAverage average; };
layout(set = 0, binding = 0) uniform sampler2D surroundings;
layout(set = 0, binding = 1) uniform sampler2D previous;
layout(set = 0, binding = 2, rgba16f) writeonly uniform image2D current;

void main() {
  ivec2 size = textureSize(surroundings, 0);
  vec3 sum = vec3(0.0);
  float count = 0.0;
  for (int y = 0; y < size.y; y += average.stride)
    for (int x = 0; x < size.x; x += average.stride) {
      sum += texelFetch(surroundings, ivec2(x, y), 0).rgb;
      count += 1.0;
    }
  vec3 mean = sum / count;
  vec3 old = average.share < 1.0 ? texelFetch(previous, ivec2(0), 0).rgb : mean;
  imageStore(current, ivec2(0), vec4(mix(old, mean, average.share), 1.0));
}
