// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Sprites lit at each pixel.

#define GLOAM_PARTICLE_PIXEL
#include "shaders/particles/drawing/sprite.glsl"
