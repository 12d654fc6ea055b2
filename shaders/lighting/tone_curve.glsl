// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_TONE_CURVE_GLSL
#define GLOAM_SHADERS_LIGHTING_TONE_CURVE_GLSL

// From exposed linear light to shown linear light, per channel:
//   0 filmic    x (2.51 x + 0.03) / (x (2.43 x + 0.59) + 0.14)   (Narkowicz 2015, fit of the ACES curve)
//   1 reinhard  x / (1 + x)
//   2 linear    x
// x lies in 0…1e6: every curve has reached white there, and its square is still a float.
vec3 tone_curve(uint curve, vec3 x) {
  vec3 shown = x;
  if (curve == 0u) shown = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
  if (curve == 1u) shown = x / (1.0 + x);
  return clamp(shown, vec3(0.0), vec3(1.0));
}

// The table's axis is logarithmic: stops around 1, from the darkest that shows to where every curve is white.
const float kTableFirstStop = -12.0;
const float kTableStops = 20.0;

#endif
