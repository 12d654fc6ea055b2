// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_BLENDED_LAYER
#include "shaders/reflections/passes/screen_space_rays.glsl"
