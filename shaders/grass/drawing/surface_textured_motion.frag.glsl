// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_MOTION
#define GLOAM_TEXTURED
#include "shaders/grass/drawing/surface.glsl"
