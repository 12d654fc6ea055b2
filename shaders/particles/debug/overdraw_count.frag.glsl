// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Counts the sprites that show at a pixel.

#define GLOAM_PARTICLE_COUNT
#include "shaders/particles/drawing/sprite.glsl"
