// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"

// The sRGB transfer functions of values in [0, 1], for the check that compares them with engine/math/srgb.h.
layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) readonly buffer Values { vec3 values[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Encoded { vec3 encoded[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Decoded { vec3 decoded[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Slopes { vec3 slopes[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= values.length()) return;
  encoded[i] = linear_to_srgb(values[i]);
  decoded[i] = srgb_to_linear(values[i]);
  slopes[i] = srgb_to_linear_slope(values[i], srgb_to_linear(values[i]));
}
