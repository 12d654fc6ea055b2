// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Filters lines through workgroup memory, in one array for each channel: neighbouring threads then read neighbouring
// words, in different banks of the memory.

const int kRoom = GLOAM_DOF_LINE + 2 * GLOAM_DOF_MOST_TAPS;
shared float cached_r[3 * kRoom], cached_g[3 * kRoom], cached_b[3 * kRoom], cached_a[3 * kRoom];
void keep(int at, vec4 texel) {
  cached_r[at] = texel.r;
  cached_g[at] = texel.g;
  cached_b[at] = texel.b;
  cached_a[at] = texel.a;
}
vec4 kept(int at) { return vec4(cached_r[at], cached_g[at], cached_b[at], cached_a[at]); }

#include "shaders/depth_of_field/blur/line.glsl"
