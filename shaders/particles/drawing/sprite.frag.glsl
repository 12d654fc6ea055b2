// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Sprites whose light was summed before.

#include "shaders/particles/drawing/sprite.glsl"
