// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/fog/fog_shared.h"

// One direction of a Gaussian blur, cut after `taps` texels and normalised. Beyond the border the border texel repeats.

layout(push_constant, scalar) uniform Blur { FogBlurConstants c; };
layout(set = 0, binding = 0) uniform sampler2D image;

layout(location = 0) out vec4 out_light;

void main() {
  ivec2 center = ivec2(gl_FragCoord.xy);
  ivec2 last = textureSize(image, 0) - 1;
  vec4 sum = texelFetch(image, center, 0);
  float total = 1.0;
  // The loop tests its condition at the end: software devices run the body once more when a test at the start fails.
  int i = 1;
  if (c.taps > 0) do {
      float distance = float(i) * c.inverse_sigma;
      float weight = exp(-0.5 * distance * distance);
      sum += weight * (texelFetch(image, clamp(center - i * c.direction, ivec2(0), last), 0) +
                       texelFetch(image, clamp(center + i * c.direction, ivec2(0), last), 0));
      total += 2.0 * weight;
    } while (++i <= c.taps);
  out_light = sum / total;
}
