// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// The tiles of a pair with a directional light.

#define GLOAM_SHADOWS_KINDS 4
#include "shaders/closeups/tiles.glsl"
