// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/display/tone_curve.glsl"

// Tabulates a tone curve over kTableStops stops, one texel per step.

layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform Table { ToneTableConstants c; };
layout(set = 0, binding = 0, rgba16f) uniform writeonly image2D table_image;

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= c.size) return;
  float x = exp2(kTableFirstStop + kTableStops * float(i) / float(c.size - 1u));
  imageStore(table_image, ivec2(i, 0), vec4(tone_curve(c.curve, vec3(x)), 1.0));
}
