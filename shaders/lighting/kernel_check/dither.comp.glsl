// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/dither_api.glsl"

// Rounds each value at the 4,096 pixels of a square to 8 bits, for the check that compares the steps with those in
// double precision.
layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer Values { float values[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Rounded { vec3 rounded[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  rounded[i] = dithered(vec3(values[i >> 12]), uvec2(i & 63u, i >> 6 & 63u));
}
