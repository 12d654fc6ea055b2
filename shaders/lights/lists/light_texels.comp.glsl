// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights/lights_shared.h"

// Writes the local lights as texels: one row of three texels per light. In shading, neighbouring pixels loop over
// different lights: a texel is one fetch of four floats, while an element of a uniform block takes one fetch per float.

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 1, rgba32f) uniform writeonly image2D texels;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= lights.local_count) return;
  LocalLight light = lights.local[i];
  imageStore(texels, ivec2(0, i), vec4(light.position, light.inverse_range_squared));
  imageStore(texels, ivec2(1, i), vec4(light.color, light.spot_scale));
  imageStore(texels, ivec2(2, i), vec4(light.direction, light.spot_offset));
}
