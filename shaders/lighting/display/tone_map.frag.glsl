// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/scattered_light_api.glsl"
#include "shaders/lighting/target.glsl"
#include "shaders/lighting/display/tone_curve.glsl"

// Maps linear light to the picture: exposure, then the curve, computed (kTable = 0) or looked up in a table (1).

layout(constant_id = 0) const uint kTable = 0u;
// 0: the picture. 1: the picture, and displayed linear light for antialiasing, which draws the pixels at edges again.
// 2: displayed linear light alone, which is accumulated over frames.
layout(constant_id = 1) const uint kOutput = 0u;
layout(constant_id = 2) const uint kScattered = 0u;  // 1: the lens scatters a share of the light
layout(constant_id = 3) const uint kDither = 0u;     // 1: the picture is rounded to 8 bits here, 0: by the target

layout(push_constant, scalar) uniform ToneMap { ToneMapConstants c; };
layout(set = 0, binding = 0) uniform sampler2D lit_image;
layout(set = 0, binding = 1, scalar) readonly buffer Exposure { float metered_exposure; };
layout(set = 0, binding = 2) uniform sampler2D table_image;
layout(set = 0, binding = 3) uniform sampler2D scattered_image;

layout(location = 0) out vec4 out_color;  // kOutput = 2: alpha is the share of light without motion
layout(location = 1) out vec4 out_shown;  // only kOutput = 1; alpha is the brightness to the eye

float looked_up(float x) {
  float size = float(textureSize(table_image, 0).x);
  float at = clamp((log2(max(x, 1e-9)) - kTableFirstStop) / kTableStops, 0.0, 1.0);
  return textureLod(table_image, vec2((at * (size - 1.0) + 0.5) / size, 0.5), 0.0).r;
}

// Drops the bits that a half float has no room for. Antialiasing blends halves, so the picture is made of halves at all
// pixels, with and without edges.
vec3 as_halves(vec3 x) { return uintBitsToFloat(floatBitsToUint(x) & 0xFFFFE000u); }

void main() {
  float exposure = c.metered != 0u ? metered_exposure * c.exposure : c.exposure;
  vec4 lit = texelFetch(lit_image, ivec2(gl_FragCoord.xy), 0);
  vec3 light = lit.rgb;
  if (kScattered != 0u) {
    vec2 at = gl_FragCoord.xy * c.scattered.uv_scale + c.scattered.uv_offset;
    light = with_scattered_light(light, textureLod(scattered_image, at, 0.0).rgb, c.scattered.share);
  }
  vec3 x = clamp(light * exposure, vec3(0.0), vec3(1e6));
  x = before_curve(c.curve, x);
  vec3 shown;
  if (kTable != 0u)
    shown = vec3(looked_up(x.r), looked_up(x.g), looked_up(x.b));
  else
    shown = tone_curve(c.curve, x);
  shown = after_curve(c.curve, shown);
  if (kOutput == 2u) {
    out_color = vec4(shown, 1.0 - lit.a);
    return;
  }
  if (kOutput == 1u) {
    out_shown = vec4(shown, sqrt(dot(shown, vec3(0.2126, 0.7152, 0.0722))));
    shown = as_halves(shown);
  }
  out_color = vec4(value_for_target(shown, uvec2(gl_FragCoord.xy), c.encode_srgb != 0u, kDither != 0u), 1.0);
}
