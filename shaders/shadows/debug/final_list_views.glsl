// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_FINAL_LIST_VIEWS_GLSL
#define GLOAM_SHADERS_SHADOWS_FINAL_LIST_VIEWS_GLSL

// What the views of final lists share beside one_light_view_api.glsl or light_views_api.glsl, whose bindings 0 to 6 are
// as there.

#define GLOAM_FINAL_LISTS_BINDING 9
#include "shaders/shadows/final_lists/entry.glsl"

layout(constant_id = 1) const uint kEarlyLists = 0u;  // 0: the view has no local lights, and no lists of them

layout(set = 0, binding = 7) uniform sampler2D depth_bounds;

const vec3 kFallbackColor = vec3(0.8, 0.0, 0.8);  // tiles that are shaded from shadow maps
const vec3 kLeftOut = vec3(0.02, 0.1, 0.6);       // lights that no pixel sees

// Whether a pixel's tile shows more than sky.
bool has_surface(uvec2 pixel) { return texelFetch(depth_bounds, ivec2(pixel / uint(GLOAM_SHADOW_TILE)), 0).y > 0.0; }

#endif
