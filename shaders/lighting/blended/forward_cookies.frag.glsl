// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Forward lighting without light lists, unshadowed, with cookies.

#define GLOAM_FORWARD_COOKIES
#include "shaders/lighting/blended/forward.glsl"
