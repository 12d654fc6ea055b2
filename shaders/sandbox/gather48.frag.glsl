// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// A yardstick: 48 gathers a pixel from a depth map, each compared with a reference, in the 8×8-and-two-mips pattern's footprint.

layout(set = 0, binding = 0) uniform sampler2D map;

layout(location = 0) out float out_share;

void main() {
  vec2 texel = 1.0 / vec2(textureSize(map, 0));
  vec2 center = gl_FragCoord.xy * texel;
  vec4 lit = vec4(0.0);
  for (int i = 0; i < 48; ++i) {
    vec2 offset = vec2(float(i & 7), float(i >> 3)) * 2.0 - vec2(7.0, 5.0);
    lit += step(vec4(0.5), textureGather(map, center + offset * texel));
  }
  out_share = dot(lit, vec4(1.0 / 192.0));
}
