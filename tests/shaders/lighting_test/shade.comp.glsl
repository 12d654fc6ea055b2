// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Forward light loop over all lights.

#include "tests/shaders/lighting_test/shade.glsl"
