// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"
#include "shaders/shadows/maps/map_shared.h"

// Visualizer shadow_atlas: draws one face into its square of the picture. White near the light, dark at the end of its
// range, blue where the map is empty. Border: orange if drawn in this frame, else green.

layout(constant_id = 0) const uint kEncode = 0u;  // 1: the picture's format does not encode sRGB

layout(push_constant, scalar) uniform Push { AtlasFaceConstants face; };
layout(set = 0, binding = 0) uniform sampler2D atlas;

layout(location = 0) out vec4 out_color;

void main() {
  vec2 at = gl_FragCoord.xy - face.corner;  // pixels
  vec2 texel = clamp(at / face.pixels * face.size, vec2(0.0), vec2(face.size - 1.0));
  float depth = texelFetch(atlas, ivec2(face.origin + texel), 0).r;
  float share = face.near_m > 0.0 ? face.near_m / max(depth, 1e-30) / max(face.far_m, face.near_m) : 1.0 - depth;
  vec3 color = depth > 0.0 ? vec3(mix(1.0, 0.02, sqrt(clamp(share, 0.0, 1.0)))) : vec3(0.0, 0.01, 0.06);
  bool border = any(lessThan(at, vec2(1.0))) || any(greaterThan(at, vec2(face.pixels - 1.0)));
  if (border) color = face.drawn > 0.0 ? vec3(0.8, 0.25, 0.0) : vec3(0.0, 0.3, 0.05);
  out_color = vec4(kEncode != 0u ? linear_to_srgb(color) : color, 1.0);
}
