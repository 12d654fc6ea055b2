// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"
#include "shaders/veil/share.glsl"

// Shows the mist's share of each pixel's light.

layout(constant_id = 0) const uint kEncode = 0u;  // 1: the target needs sRGB from the shader

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_value;  // the plain share

void main() {
  vec3 color = vec3(mist_share());
  out_color = vec4(kEncode != 0u ? linear_to_srgb(color) : color, 1.0);
  out_value = vec4(mist_share(), 0.0, 0.0, 1.0);
}
