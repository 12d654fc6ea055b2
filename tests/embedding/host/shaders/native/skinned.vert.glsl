// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/caster_api.glsl"

// A posed vertex of the skinned mesh, in the world.

layout(location = 0) in vec3 in_position;
layout(push_constant, scalar) uniform Push { CasterConstants caster; };

void main() { gl_Position = caster_position(caster, in_position); }
