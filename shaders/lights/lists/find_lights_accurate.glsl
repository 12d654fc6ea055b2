// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_LISTS_FIND_LIGHTS_ACCURATE_GLSL
#define GLOAM_SHADERS_LIGHTS_LISTS_FIND_LIGHTS_ACCURATE_GLSL

#include "shaders/lights/froxel_api.glsl"

// Bindings of both shaders of the accurate search, and the reconstruction of pixel positions.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2, scalar) uniform Grid { LightGrid grid; };
layout(set = 0, binding = 3) uniform sampler2D depth_image;
layout(set = 0, binding = 4) uniform sampler2D light_texels;
layout(set = 0, binding = 5) uniform sampler2D depth_bounds;
layout(set = 0, binding = 6, scalar) readonly buffer GroupMasks { uint group_masks[]; };
layout(set = 0, binding = 7, rg32ui) uniform uimage2D tile_lists;
layout(set = 0, binding = 8, scalar) writeonly buffer EarlyLists { uint early_lists[]; };
layout(set = 0, binding = 9, scalar) buffer Counters { LightCounters counters; };

// Camera-relative position of a pixel with this depth value. For sky and outside the image: a position that no light
// reaches.
vec3 point_at(uvec2 pixel, float depth) {
  if (depth <= 0.0 || any(greaterThanEqual(pixel, view.size))) return vec3(1e30);
  return relative_position(view, vec2(pixel), depth);
}

vec3 pixel_point(uvec2 pixel) {
  return point_at(pixel, texelFetch(depth_image, ivec2(min(pixel, view.size - 1u)), 0).r);
}

#endif
