// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_TILES_SPREAD_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_TILES_SPREAD_GLSL

// How far tiles are searched. Include this after the uniform `dof` and the buffer `picture`.

// Tiles that a pixel before the focus reaches at a level with a circle of this radius: its kernel, and the texels that
// are interpolated around it.
bool reaches(float radius, int level, int apart) {
  float between = level == 0 ? 1.0 : 1.5 * float(1 << level);
  return radius + between > float(max(apart - 1, 0) * GLOAM_DOF_TILE);
}

// The farthest tile that circles before the focus reach, in the whole picture.
int near_spread() {
  float radius = uintBitsToFloat(picture.near_radius);
  float between = 1.5 * float(1 << max(findMSB(picture.near_levels), 0));
  return radius > 0.0 ? 1 + int((radius + between) / float(GLOAM_DOF_TILE)) : 0;
}

// The farthest tile whose texels kernels read, in the whole picture.
int kernel_spread() {
  int spread = 0;
  for (int k = 0; k <= findMSB(picture.far_levels | picture.near_levels); ++k) spread = max(spread, dof.spread[k]);
  return spread;
}

#endif
