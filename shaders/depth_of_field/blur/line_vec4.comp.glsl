// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Filters lines through workgroup memory, in one array of vectors.

const int kRoom = GLOAM_DOF_LINE + 2 * GLOAM_DOF_MOST_TAPS;
shared vec4 cached[3 * kRoom];
void keep(int at, vec4 texel) { cached[at] = texel; }
vec4 kept(int at) { return cached[at]; }

#include "shaders/depth_of_field/blur/line.glsl"
