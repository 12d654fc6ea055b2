// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Forward lighting with tile masks and zBins, unshadowed, without cookies.

#define GLOAM_Z_BINS_BINDING 5
#include "shaders/lighting/forward_tile_lights.glsl"
