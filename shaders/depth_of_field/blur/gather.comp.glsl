// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Gathers a layer without workgroup memory.

const int kKeeps = 0;
void keep(int at, vec4 texel) {}
vec4 kept(int at) { return vec4(0.0); }

#include "shaders/depth_of_field/blur/gather.glsl"
