// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/render/caster_api.glsl"
#include "shaders/render/draw_shared.h"

// Draws the depth of cut-out casters: as map.vert, with the values that the alpha test needs.

layout(location = 0) in vec3 in_position;
layout(location = 1) in vec4 in_uv;
layout(location = 2) in vec4 in_color;

layout(location = 0) out vec3 out_uv_alpha;

layout(push_constant, scalar) uniform CasterBlock { CasterConstants caster; };
layout(set = 1, binding = 0, scalar) uniform MaterialBlock { MaterialConstants material; };

void main() {
  gl_Position = caster_position(caster, in_position);
  vec4 row0 = material.uv_transform[0];
  vec4 row1 = material.uv_transform[1];
  vec3 uv = vec3(row0.w < 0.5 ? in_uv.xy : in_uv.zw, 1.0);
  out_uv_alpha = vec3(dot(row0.xyz, uv), dot(row1.xyz, uv), in_color.a);  // in_color is white where a mesh has none
}
