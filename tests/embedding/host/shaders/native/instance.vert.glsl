// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/caster_api.glsl"

// A cube for each instance, 36 vertices.

layout(location = 0) in vec4 in_cube;  // xyz: centre in the world, w: half size
layout(push_constant, scalar) uniform Push { CasterConstants caster; };

void main() {
  int face = gl_VertexIndex / 6, corner = gl_VertexIndex % 6;
  int axis = face / 2;
  vec2 square = vec2(corner == 1 || corner == 2 || corner == 4 ? 1.0 : -1.0, corner >= 2 && corner != 3 ? 1.0 : -1.0);
  vec3 at;
  at[axis] = face % 2 == 0 ? 1.0 : -1.0;
  at[(axis + 1) % 3] = square.x;
  at[(axis + 2) % 3] = square.y;
  gl_Position = caster_position(caster, in_cube.xyz + in_cube.w * at);
}
