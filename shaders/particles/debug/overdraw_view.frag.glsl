// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shaders/common/heat.glsl"
#include "shaders/common/math.glsl"

// Visualizer of the number of sprites at each pixel: heat colours for 0 to 63, white from 64.

layout(constant_id = 0) const uint kEncode = 0u;  // 1: the target needs sRGB from the shader

layout(set = 0, binding = 0) uniform sampler2D layers;

layout(location = 0) out vec4 out_color;
layout(location = 1) out vec4 out_value;

void main() {
  vec2 count = texelFetch(layers, ivec2(gl_FragCoord.xy), 0).rg;
  vec3 color = heat(count.x / 63.0);
  out_color = vec4(kEncode != 0u ? linear_to_srgb(color) : color, 1.0);
  out_value = vec4(count, 0.0, 1.0);
}
