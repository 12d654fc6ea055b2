// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_FINAL_LIST_VIEWS_GLSL
#define GLOAM_SHADERS_SHADOWS_FINAL_LIST_VIEWS_GLSL

// Shared by the visualizers of final lists. Include after one_light_view_api.glsl or light_views_api.glsl, which define
// bindings 0 to 6.

#define GLOAM_FINAL_LISTS_BINDING 9
#include "shaders/shadows/final_lists/entry.glsl"

layout(constant_id = 1) const uint kEarlyLists = 0u;  // 0: the view has no local lights and no early lists

layout(set = 0, binding = 7) uniform sampler2D depth_bounds;

const vec3 kFallbackColor = vec3(0.8, 0.0, 0.8);  // fallback tiles
const vec3 kLeftOut = vec3(0.02, 0.1, 0.6);       // lights without an entry: no pixel sees them

// Whether the pixel's tile has a surface.
bool has_surface(uvec2 pixel) { return texelFetch(depth_bounds, ivec2(pixel / uint(GLOAM_SHADOW_TILE)), 0).y > 0.0; }

#endif
