// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require

// Draws the nearest blades into a shadow map.

#include "shaders/render/caster_api.glsl"

layout(constant_id = 1) const uint kSegments = 5u;

layout(push_constant, scalar) uniform CasterBlock { CasterConstants caster; };

#include "shaders/grass/drawing/blade_shape.glsl"

void main() {
  BladeVertex v = blade_vertex(gl_InstanceIndex, 0u, draws.cast_count, gl_VertexIndex, kSegments);
  gl_Position = v.exists ? caster_position(caster, v.relative) : vec4(2.0, 2.0, 2.0, 1.0);
}
