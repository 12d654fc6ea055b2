// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights/light_views_api.glsl"

// Stands in for a visualizer of lists that has nothing to show: there are no lists, or the light is in no tile.

layout(push_constant, scalar) uniform Push { float opacity; };

void main() { show(vec3(0.0), opacity); }
