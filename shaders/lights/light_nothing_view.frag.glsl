// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights/light_views_api.glsl"

// A view of lists where there are none: no tile has a light, or the light is in no tile.

layout(push_constant, scalar) uniform Push { float opacity; };

void main() { show(vec3(0.0), opacity); }
