// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Forward lighting without light lists, with shadows and cookies.

#define GLOAM_SHADOWS_BINDING 7
#include "shaders/lighting/forward_all_lights.glsl"
