// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/lighting_shared.h"
#include "shaders/lighting/target.glsl"

// Blends each pixel with the neighbours that cover a share of it, in displayed linear light, and draws it again.
// Pixels without a share stay as they are. Two shares are weighted by themselves, as in SMAA.

layout(constant_id = 0) const uint kDither = 0u;

layout(push_constant, scalar) uniform Blend { AntialiasingConstants c; };
layout(set = 0, binding = 0) uniform sampler2D shown_image;
layout(set = 0, binding = 1, scalar) readonly buffer PixelWeights { uint weights[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Masks { uint masks[]; };  // the pixels with weights

layout(location = 0) out vec4 out_color;

vec3 shown(ivec2 pixel) { return texelFetch(shown_image, clamp(pixel, ivec2(0), ivec2(c.size) - 1), 0).rgb; }

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  uint mask = masks[uint(pixel.y) * ((c.size.x + 31u) / 32u) + uint(pixel.x) / 32u];
  if ((mask >> (uint(pixel.x) % 32u) & 1u) == 0u) discard;
  vec3 own = shown(pixel), color = own;
  vec4 shares = unpackUnorm4x8(weights[uint(pixel.y) * c.size.x + uint(pixel.x)]);
  bool vertical = shares.x + shares.y > 0.0;
  float before = vertical ? shares.x : shares.z, after = vertical ? shares.y : shares.w;
  ivec2 step = ivec2(vertical ? 0 : 1, vertical ? 1 : 0);
  if (before > 0.0) color += before * before / (before + after) * (shown(pixel - step) - own);
  if (after > 0.0) color += after * after / (before + after) * (shown(pixel + step) - own);
  out_color = vec4(value_for_target(color, uvec2(pixel), c.encode_srgb != 0u, kDither != 0u), 1.0);
}
