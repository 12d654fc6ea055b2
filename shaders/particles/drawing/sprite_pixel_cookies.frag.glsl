// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Sprites lit at each pixel, through cookies.

#define GLOAM_PARTICLE_PIXEL
#define GLOAM_FORWARD_COOKIES
#include "shaders/particles/drawing/sprite.glsl"
