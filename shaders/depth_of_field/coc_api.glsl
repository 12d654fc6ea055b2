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

// Where circles pass to a level from the one before it, and to the next one: clamped to 0…1, factor · radius + offset.
struct LevelRange {
  vec2 below;
  vec2 above;
};
LevelRange level_range(int level) {
  int before = max(level - 1, 0);
  vec2 below = vec2(1.0, -dof.from[before]) / (dof.to[before] - dof.from[before]);
  vec2 above = vec2(1.0, -dof.from[level]) / (dof.to[level] - dof.from[level]);
  return LevelRange(level == dof.first_level ? vec2(0.0, 1.0) : below, level == dof.last_level ? vec2(0.0) : above);
}

// Share of a level in the blur of circles of this radius in pixels. The shares of all levels sum to 1.
float level_share(LevelRange range, float radius) {
  return clamp(range.below.x * radius + range.below.y, 0.0, 1.0) *
         (1.0 - clamp(range.above.x * radius + range.above.y, 0.0, 1.0));
}

// Exponents are compared, because compilers may assume that comparisons of floats never see NaN.
bool is_finite(vec3 v) {
  uvec3 exponents = floatBitsToUint(v) & 0x7F800000u;
  return exponents.x != 0x7F800000u && exponents.y != 0x7F800000u && exponents.z != 0x7F800000u;
}

#endif
