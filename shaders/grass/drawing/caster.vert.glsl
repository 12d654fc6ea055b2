// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Draws the listed blades into a shadow map.

#include "shaders/render/caster_api.glsl"

layout(constant_id = 1) const uint kSegments = 5u;

layout(push_constant, scalar) uniform CasterBlock { CasterConstants caster; };

#include "shaders/grass/drawing/blade_shape.glsl"

layout(set = 0, binding = 4, scalar) readonly buffer Casting { GrassCasting casting; };
layout(set = 0, binding = 5, scalar) readonly buffer Casters { uint casters[]; };  // places among the poses

void main() {
  uint blade = blade_of_vertex(gl_InstanceIndex, gl_VertexIndex, kSegments);
  uint place = casters[min(blade, max(casting.count, 1u) - 1u)];
  BladeVertex v = blade_vertex(min(place, draws.live), gl_VertexIndex, kSegments, casting.wider);
  gl_Position = blade < casting.count ? caster_position(caster, v.relative) : vec4(2.0, 2.0, 2.0, 1.0);
}
