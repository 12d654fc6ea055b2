// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_ONE_LIGHT_VIEW_API_GLSL
#define GLOAM_SHADERS_LIGHTS_ONE_LIGHT_VIEW_API_GLSL

// Membership of one light in the lists, for the visualizers that show it. Define GLOAM_SHOWN_DIRECTIONAL if the light
// may be directional.

#define GLOAM_EARLY_LISTS_BINDING 6
#include "shaders/lights/light_lists_api.glsl"
#include "shaders/lights/light_views_api.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Grid { LightGrid grid; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform sampler2D light_texels;
layout(set = 0, binding = 4, scalar) readonly buffer GroupMasks { uint group_masks[]; };
layout(set = 0, binding = 5) uniform usampler2D tile_lists;

layout(push_constant, scalar) uniform Push {
  uint shown_light;  // index among the sorted local lights
#ifdef GLOAM_SHOWN_DIRECTIONAL
  uint shown_directional;  // 1: shown_light is an index among the directional lights
#endif
};

// Whether the mask of a pixel's tile group holds the light.
bool group_mask_holds(uvec2 pixel) {
  uint at = group_mask_of(grid, pixel), word = shown_light >> 5;
  return (group_masks[at] >> word & 1u) != 0u && (group_masks[at + 1u + word] >> (shown_light & 31u) & 1u) != 0u;
}

// Whether a pixel is shaded with the light: it is in the list of the pixel's tile or, if the tile has no list, in the
// mask of the tile group.
bool list_holds(uvec2 pixel) {
  uvec2 tile_list = texelFetch(tile_lists, ivec2(pixel / GLOAM_SHADOW_TILE), 0).xy;
  if (!has_list(tile_list)) return group_mask_holds(pixel);
  bool found = false;
  for (uint i = 0u; i < list_count(tile_list) && !found; ++i) found = list_light(tile_list.x, i) == shown_light;
  return found;
}

// Whether the light reaches the surface at a pixel. Independent of the lists.
bool lights_pixel(LocalLight light, uvec2 pixel) {
  float depth = texelFetch(depth_image, ivec2(pixel), 0).x;
  light.color = vec3(1.0);  // tests reach only, not intensity
  vec3 to_light;
  return depth > 0.0 && local_illuminance(light, relative_position(view, vec2(pixel), depth), to_light).x > 0.0;
}

#endif
