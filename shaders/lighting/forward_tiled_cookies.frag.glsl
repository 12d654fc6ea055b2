// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Forward lighting with tile masks and zBins, unshadowed, with cookies.

#define GLOAM_Z_BINS_BINDING 5
#define GLOAM_COOKIES_BINDING 7
#include "shaders/lighting/forward_tile_lights.glsl"
