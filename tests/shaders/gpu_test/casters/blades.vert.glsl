// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/shaders/gpu_test/casters/blades_shared.h"
#include "shaders/render/caster_api.glsl"

// Draws blades into shadow maps without vertex streams, for the tests of caster sources.

layout(push_constant, scalar) uniform CasterBlock { CasterConstants caster; };
layout(set = 0, binding = 0, scalar) readonly buffer Blades { Blade blades[]; };

void main() {
  Blade blade = blades[gl_VertexIndex / 3];
  int corner = gl_VertexIndex % 3;
  vec3 side = vec3(blade.half_width, 0.0, 0.0);
  vec3 position = corner == 0 ? blade.root - side : corner == 1 ? blade.root + side : blade.tip;
  gl_Position = caster_position(caster, position);
}
