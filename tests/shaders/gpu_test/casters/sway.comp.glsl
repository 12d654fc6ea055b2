// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/shaders/gpu_test/casters/blades_shared.h"

// Moves the tips of blades, for the tests of caster sources.
layout(local_size_x = 64) in;

layout(push_constant, scalar) uniform SwayBlock { SwayConstants sway; };
layout(set = 0, binding = 0, scalar) readonly buffer RestingBlades { Blade resting[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Blades { Blade blades[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= sway.count) return;
  Blade blade = resting[i];
  blade.tip.x += sway.reach * sin(sway.phase + 1.3 * float(i));
  blades[i] = blade;
}
