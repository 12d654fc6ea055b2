// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/heat.glsl"
#include "shaders/common/math.glsl"
#include "shaders/grass/drawing/pixel_width.glsl"

// Colours each blade by its draw class, darker toward the root.

layout(constant_id = 2) const uint kEncode = 0u;  // 1: the target needs sRGB from the shader

layout(constant_id = 0) const uint kClass = 0u;
layout(location = 2) in vec3 in_place;
layout(location = 6) in vec2 in_coverage;  // coverage; threshold of the blade
layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_value;

void main() {
  if (is_left_out(in_coverage.x, in_coverage.y)) discard;
  const vec3 kColors[4] = vec3[](vec3(0.9, 0.2, 0.1), vec3(0.9, 0.7, 0.1), vec3(0.2, 0.7, 0.2), vec3(0.2, 0.4, 0.9));
  vec3 color = kColors[kClass] * mix(0.4, 1.0, in_place.x);
  out_color = vec4(kEncode != 0u ? linear_to_srgb(color) : color, 1.0);
  out_value = vec4(float(kClass + 1u), in_place.x, 0.0, 1.0);
}
