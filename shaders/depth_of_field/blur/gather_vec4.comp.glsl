// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Gathers a layer through workgroup memory, in one array of vectors.

const int kKeeps = 1;
shared vec4 cached[GLOAM_DOF_ROOM * GLOAM_DOF_ROOM];
void keep(int at, vec4 texel) { cached[at] = texel; }
vec4 kept(int at) { return cached[at]; }

#include "shaders/depth_of_field/blur/gather.glsl"
