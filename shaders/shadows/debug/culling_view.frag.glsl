// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"

// Visualizers shadow_unculled and shadow_filtered: the visibility of a light without culling in grey; pixels whose
// drawn visibility differs in colour.

layout(constant_id = 0) const uint kEncode = 0u;    // 1: the picture's format does not encode sRGB
layout(constant_id = 1) const uint kCloseups = 0u;  // 1: `closeups` exists

layout(set = 0, binding = 0) uniform sampler2D unculled;
layout(set = 0, binding = 1) uniform sampler2D drawn;
layout(set = 0, binding = 2) uniform sampler2D closeups;  // visibility that close-up maps leave

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_values;

const float kLeast = 0.25 / 255.0;  // below the least difference of quantised visibilities
const vec3 kDarker = vec3(0.8, 0.02, 0.02);
const vec3 kBrighter = vec3(0.0, 0.6, 0.75);
const vec3 kOutOfReach = vec3(0.0, 0.0, 0.04);

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float expected = texelFetch(unculled, pixel, 0).x, shown = texelFetch(drawn, pixel, 0).x;
  if (kCloseups != 0u) expected = min(expected, texelFetch(closeups, pixel, 0).x);
  float difference = shown - expected;
  vec3 color = expected < 0.0 ? kOutOfReach : vec3(expected);
  if (abs(difference) > kLeast)
    color = mix(0.3 * color, difference < 0.0 ? kDarker : kBrighter, 0.5 + 0.5 * min(abs(difference), 1.0));
  out_color = vec4(kEncode != 0u ? linear_to_srgb(color) : color, 1.0);
  out_values = vec4(expected, shown, abs(difference), 1.0);
}
