// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Lights sprites through cookies.

#define GLOAM_FORWARD_COOKIES
#include "shaders/particles/lighting/light.glsl"
