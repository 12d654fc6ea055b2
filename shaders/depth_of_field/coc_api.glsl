// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_COC_API_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_COC_API_GLSL

#include "shaders/depth_of_field/depth_of_field_shared.h"

// Include this after the uniform `dof`.

// Radius of a circle of confusion in pixels; smaller ones are in focus.
const float kInFocus = 0.5;

// Signed radius of the circle of confusion of a point at this depth, in pixels; positive behind the focus.
float circle_of_confusion(float depth) {
  return clamp(dof.coc_offset + dof.coc_slope * depth, -dof.radius, dof.radius);
}

// Share of a blurred layer in a pixel: 0 in focus, 1 where the circle is wide enough for the layer alone. coc: positive
// in the layer.
float layer_share(float coc) { return clamp((coc - kInFocus) / dof.blend, 0.0, 1.0); }

// Exponents are compared, because compilers may assume that comparisons of floats never see NaN.
bool is_finite(vec3 v) {
  uvec3 exponents = floatBitsToUint(v) & 0x7F800000u;
  return exponents.x != 0x7F800000u && exponents.y != 0x7F800000u && exponents.z != 0x7F800000u;
}

#endif
