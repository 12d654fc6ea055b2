// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shadows/maps/map_position.glsl"

// Draws the depth of opaque casters into one face of a light. There is no fragment shader.

layout(location = 0) in vec3 in_position;

layout(push_constant, scalar) uniform DrawBlock { ShadowDrawConstants draw; };

void main() { gl_Position = map_position(draw, in_position); }
