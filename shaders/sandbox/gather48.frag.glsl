// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// Yardstick for frame times: the least work of a contact-hardening shadow filter. 48 gathers per pixel from a depth
// map, spread over a footprint whose width varies from pixel to pixel; each is compared with a plane through the
// receiver.

layout(set = 0, binding = 0) uniform sampler2D map;

layout(location = 0) out float out_share;

void main() {
  vec2 texel = 1.0 / vec2(textureSize(map, 0));
  vec2 center = gl_FragCoord.xy * texel;
  float width = 1.0 + fract(gl_FragCoord.x * 0.0371 + gl_FragCoord.y * 0.0173);
  vec2 slope = vec2(width - 1.5, 1.5 - width) * 0.01;
  vec4 lit = vec4(0.0);
  for (int i = 0; i < 48; ++i) {
    vec2 offset = (vec2(float(i & 7), float(i >> 3)) * 2.0 - vec2(7.0, 5.0)) * width;
    vec4 plane = vec4(0.5 + dot(offset, slope)) + vec4(0.0, slope.x, slope.x + slope.y, slope.y);
    lit += step(plane, textureGather(map, center + offset * texel));
  }
  out_share = dot(lit, vec4(1.0 / 192.0));
}
