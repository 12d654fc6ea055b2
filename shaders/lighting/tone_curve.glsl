// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_TONE_CURVE_GLSL
#define GLOAM_SHADERS_LIGHTING_TONE_CURVE_GLSL

// Maps exposed linear light to displayed linear light, per channel:
//   0 filmic    x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14)   (Narkowicz 2015, fit of the ACES curve)
//   1 reinhard  x / (1 + x)
//   2 linear    x
// x: in 0…1e6. Every curve has reached white at 1e6, and its square still fits a float.
vec3 tone_curve(uint curve, vec3 x) {
  vec3 shown = x;
  if (curve == 0u) shown = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  if (curve == 1u) shown = x / (1.0 + x);
  return clamp(shown, vec3(0.0), vec3(1.0));
}

// Logarithmic axis of the table, in stops around 1: from the darkest visible value to where every curve is white.
const float kTableFirstStop = -12.0;
const float kTableStops = 20.0;

#endif
