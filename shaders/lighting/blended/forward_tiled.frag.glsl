// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Forward lighting with tile masks and zBins, unshadowed, without cookies.

#define GLOAM_FORWARD_TILED
#include "shaders/lighting/blended/forward.glsl"
