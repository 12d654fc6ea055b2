// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Forward light loop over tile masks and zBins, with shadows of the standard filter.

#define GLOAM_FORWARD_TILED
#define GLOAM_FORWARD_SHADOWS
#define GLOAM_SHADOWS_STANDARD
#include "tests/shaders/lighting_test/shade.glsl"
