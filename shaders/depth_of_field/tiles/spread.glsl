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

// The farthest tile whose texels kernels of a level read, in the whole picture.
int kernel_spread(int level) {
  float greatest = level == dof.last_level ? dof.radius : GLOAM_DOF_NEAR_FINER * dof.to[level];
  float radius = min(uintBitsToFloat(picture.radius), greatest);
  int taps = int(sqrt(float(texels_of(kernel_radius(radius, level)))));
  return ((taps << level) + GLOAM_DOF_TILE - 1) / GLOAM_DOF_TILE;
}

// Of each level; 0 for those that the picture does not have.
int spreads[GLOAM_DOF_LEVELS];
int find_spreads() {
  uint levels = picture.far_levels | picture.near_levels;
  int most = 0;
  for (int k = 0; k < GLOAM_DOF_LEVELS; ++k) {
    spreads[k] = (levels >> k & 1u) != 0u ? kernel_spread(k) : 0;
    most = max(most, spreads[k]);
  }
  return most;
}
// Levels whose kernels read tiles so far apart.
uint levels_read(int apart) {
  uint read = 0u;
  for (int k = 0; k < GLOAM_DOF_LEVELS; ++k) read |= apart <= spreads[k] ? 1u << k : 0u;
  return read;
}

#endif
