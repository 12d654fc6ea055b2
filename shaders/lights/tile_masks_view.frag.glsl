// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/heat.glsl"
#include "shaders/common/math.glsl"
#include "shaders/lights/lights_shared.h"

// How many lights each tile's mask holds: white from 32 on.

layout(constant_id = 0) const uint kEncodeSrgb = 0u;

layout(set = 0, binding = 0) uniform usampler2DArray mask_image;

layout(location = 0) out vec4 out_color;

void main() {
  ivec2 tile = ivec2(gl_FragCoord.xy) / 8;
  int count = 0;
  uint groups = texelFetch(mask_image, ivec3(tile, GLOAM_LIGHT_GROUPS), 0).x;
  for (; groups != 0u; groups &= groups - 1u) count += bitCount(texelFetch(mask_image, ivec3(tile, findLSB(groups)), 0).x);
  vec3 color = heat(float(count) / 31.0);
  if (any(equal(ivec2(gl_FragCoord.xy) % 8, ivec2(0)))) color *= 0.6;  // the grid
  out_color = vec4(kEncodeSrgb != 0u ? linear_to_srgb(color) : color, 1.0);
}
