// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/math.glsl"
#include "shaders/lighting/lighting_shared.h"

// Linear light to picture. Curves, on exposed light x per channel:
//   filmic    x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14)   (Narkowicz 2015, fit of the ACES curve)
//   reinhard  x / (1 + x)
//   linear    x

layout(push_constant, scalar) uniform ToneMap { ToneMapConstants c; };
layout(set = 0, binding = 0) uniform sampler2D lit_image;
layout(set = 0, binding = 1, scalar) readonly buffer Exposure { float exposures[]; };

layout(location = 0) out vec4 out_color;

void main() {
  float exposure = c.metered != 0u ? exposures[c.exposure_slot] : c.exposure;
  // Every curve has reached white at the upper end, and its square is still a float.
  vec3 x = clamp(texelFetch(lit_image, ivec2(gl_FragCoord.xy), 0).rgb * exposure, vec3(0.0), vec3(1e6));
  vec3 shown = x;
  if (c.curve == 0u) shown = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  if (c.curve == 1u) shown = x / (1.0 + x);
  shown = clamp(shown, vec3(0.0), vec3(1.0));
  out_color = vec4(c.encode_srgb != 0u ? linear_to_srgb(shown) : shown, 1.0);
}
