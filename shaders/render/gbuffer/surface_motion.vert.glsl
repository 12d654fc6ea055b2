// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// surface.vert with positions of the previous frame.

#define GLOAM_MOTION
#include "shaders/render/gbuffer/surface.glsl"
