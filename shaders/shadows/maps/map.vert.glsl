// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/caster_api.glsl"

// Draws the depth of opaque casters into one face of a light. There is no fragment shader.

layout(location = 0) in vec3 in_position;

layout(push_constant, scalar) uniform CasterBlock { CasterConstants caster; };

void main() { gl_Position = caster_position(caster, in_position); }
