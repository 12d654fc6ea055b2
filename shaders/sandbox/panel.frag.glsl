// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"

// Draws Dear ImGui's triangles. Its colours are sRGB-encoded: they are decoded first for a target that encodes sRGB
// (kDecode = 1), and written unchanged to other targets.

layout(set = 0, binding = 0) uniform sampler2D font;  // coverage in red

layout(constant_id = 0) const uint kDecode = 0u;  // 1: the target encodes sRGB

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 out_color;

void main() {
  vec3 shown = kDecode != 0u ? srgb_to_linear(color.rgb) : color.rgb;
  out_color = vec4(shown, color.a * texture(font, uv).r);
}
