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
layout(set = 0, binding = 5, scalar) readonly buffer Casters { uint casters[]; };  // see pose.comp

void main() {
  uint blade = blade_of_vertex(gl_InstanceIndex, gl_VertexIndex, kSegments);
  uint caster_word = casters[min(blade, max(casting.count, 1u) - 1u)], place = caster_word & ~GLOAM_GRASS_NOT_WIDER;
  float wider = caster_word == place ? casting.wider : 1.0;
  BladeVertex v = blade_vertex(min(place, max(draws.live, 1u) - 1u), gl_VertexIndex, kSegments, wider);
  gl_Position = blade < casting.count ? caster_position(caster, v.relative) : vec4(2.0, 2.0, 2.0, 1.0);
}
