// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Gathers a layer through workgroup memory, in one array for each channel: neighbouring threads then read neighbouring
// words, in different banks of the memory.

const int kKeeps = 1;
const int kRoom = GLOAM_DOF_ROOM * GLOAM_DOF_ROOM;
shared float cached_r[kRoom], cached_g[kRoom], cached_b[kRoom], cached_a[kRoom];
void keep(int at, vec4 texel) {
  cached_r[at] = texel.r;
  cached_g[at] = texel.g;
  cached_b[at] = texel.b;
  cached_a[at] = texel.a;
}
vec4 kept(int at) { return vec4(cached_r[at], cached_g[at], cached_b[at], cached_a[at]); }

#include "shaders/depth_of_field/blur/gather.glsl"
