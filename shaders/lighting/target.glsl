// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_TARGET_GLSL
#define GLOAM_SHADERS_LIGHTING_TARGET_GLSL

#include "shaders/common/math.glsl"
#include "shaders/lighting/dither_api.glsl"

// The value for a target of 8 bits that shows displayed linear light. encode_srgb: the target does not encode sRGB
// itself. dither: round to 8 bits here.
vec3 value_for_target(vec3 shown, uvec2 pixel, bool encode_srgb, bool dither) {
  if (!dither) return encode_srgb ? linear_to_srgb(shown) : shown;
  vec3 encoded = linear_to_srgb(shown);
  vec3 rounded = dithered(encoded, pixel);
  if (encode_srgb) return rounded;
  // The target encodes once more. The tangent of the decoding curve is exact to 0.07 steps, so the target rounds to the
  // same step.
  return shown + (rounded - encoded) * srgb_to_linear_slope(encoded, shown);
}

#endif
