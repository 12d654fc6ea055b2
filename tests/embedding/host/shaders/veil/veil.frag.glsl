// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/veil/share.glsl"

// Replaces the mist's share of the light by light of the surroundings. Premultiplied blending keeps the rest of the
// target.

layout(set = 0, binding = 2) uniform sampler2D glow;  // one texel: mean light around

layout(location = 0) out vec4 out_light;

void main() {
  float share = mist_share();
  out_light = vec4(share * veil.albedo * texelFetch(glow, ivec2(0), 0).rgb, share);
}
