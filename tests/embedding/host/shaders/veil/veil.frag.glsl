// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/view_api.glsl"
#include "shaders/veil/veil_shared.h"

// Attenuates light by exp(-density · distance) and adds light of the surroundings for the lost share. Premultiplied
// blending keeps the rest of the target.

layout(push_constant, scalar) uniform Veil { VeilConstants veil; };
layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2) uniform sampler2D glow;  // one texel: mean light around

layout(location = 0) out vec4 out_light;

void main() {
  float depth = texelFetch(depth_image, ivec2(gl_FragCoord.xy), 0).r;
  float distance_m = view_depth(view, relative_position(view, gl_FragCoord.xy - 0.5, max(depth, 1e-9)));
  float share = depth > 0.0 ? 1.0 - exp(-veil.density * distance_m) : 1.0;
  out_light = vec4(share * veil.albedo * texelFetch(glow, ivec2(0), 0).rgb, share);
}
