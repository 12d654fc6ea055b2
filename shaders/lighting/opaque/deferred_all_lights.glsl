// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_OPAQUE_DEFERRED_ALL_LIGHTS_GLSL
#define GLOAM_SHADERS_LIGHTING_OPAQUE_DEFERRED_ALL_LIGHTS_GLSL

#include "shaders/lighting/opaque/deferred.glsl"

// Deferred lighting without light lists: every pixel loops over every light of the view.

vec3 local_lights(ShadingPoint p, uvec2 pixel) {
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < lights.local_count; ++i) sum += add_local(p, i, 1.0);
  return sum;
}

#endif
