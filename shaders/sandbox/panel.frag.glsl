// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// Draws Dear ImGui's triangles. Its colours are sRGB-encoded: they are decoded first for a target that encodes sRGB
// (kDecode = 1), and written unchanged to other targets.

layout(set = 0, binding = 0) uniform sampler2D font;  // coverage in red

layout(constant_id = 0) const uint kDecode = 0u;  // 1: the target encodes sRGB

layout(location = 0) in vec2 uv;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 out_color;

vec3 srgb_to_linear(vec3 c) {
  return mix(pow((c + 0.055) / 1.055, vec3(2.4)), c / 12.92, lessThanEqual(c, vec3(0.04045)));
}

void main() {
  vec3 shown = kDecode != 0u ? srgb_to_linear(color.rgb) : color.rgb;
  out_color = vec4(shown, color.a * texture(font, uv).r);
}
