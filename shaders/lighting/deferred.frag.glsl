// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/deferred.glsl"

// Every pixel looks at every light of the view.

vec3 local_lights(ShadingPoint p, uvec2 pixel) {
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < lights.local_count; ++i) sum += add_local(p, i);
  return sum;
}
