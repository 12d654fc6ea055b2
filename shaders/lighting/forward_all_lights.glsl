// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_FORWARD_ALL_LIGHTS_GLSL
#define GLOAM_SHADERS_LIGHTING_FORWARD_ALL_LIGHTS_GLSL

#include "shaders/lighting/forward.glsl"

// Forward lighting without light lists: every fragment loops over every light of the view.

vec3 local_lights(ShadingPoint p) {
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < lights.local_count; ++i) sum += add_local(p, i, lights.local[i]);
  return sum;
}

#endif
