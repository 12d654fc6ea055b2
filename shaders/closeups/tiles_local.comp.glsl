// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// The tiles of a pair with a local light.

#define GLOAM_SHADOWS_KINDS 1
#include "shaders/closeups/tiles.glsl"
