// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Illuminance by lights on both sides of the surface, without shadows.

#define GLOAM_FORWARD_TILED
#define GLOAM_FORWARD_RESPONSE
#include "tests/shaders/lighting_test/shade.glsl"
