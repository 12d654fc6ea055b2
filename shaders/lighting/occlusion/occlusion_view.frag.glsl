// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"

// Shows the share of the surroundings' light that nearby surfaces leave.

layout(constant_id = 0) const uint kEncode = 0u;  // 1: the target needs sRGB from the shader

layout(set = 0, binding = 0) uniform sampler2D hidden_image;

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_value;  // the share

void main() {
  float left = 1.0 - texelFetch(hidden_image, ivec2(gl_FragCoord.xy), 0).r;
  out_color = vec4(kEncode != 0u ? linear_to_srgb(vec3(left)) : vec3(left), 1.0);
  out_value = vec4(left, 0.0, 0.0, 1.0);
}
