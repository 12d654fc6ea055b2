// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Forward lighting with tile masks and zBins, with shadows and cookies.

#define GLOAM_FORWARD_TILED
#define GLOAM_FORWARD_SHADOWS
#include "shaders/lighting/blended/forward.glsl"
