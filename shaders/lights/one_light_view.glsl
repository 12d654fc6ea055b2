// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_ONE_LIGHT_VIEW_GLSL
#define GLOAM_SHADERS_LIGHTS_ONE_LIGHT_VIEW_GLSL

// Where one light is in the lists, for the views that show it.

#include "shaders/lights/light_views.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Grid { LightGrid grid; };
layout(set = 0, binding = 2) uniform sampler2D depth_image;
layout(set = 0, binding = 3) uniform sampler2D light_texels;
layout(set = 0, binding = 4, scalar) readonly buffer GroupMasks { uint group_masks[]; };
layout(set = 0, binding = 5) uniform usampler2D tile_lists;
layout(set = 0, binding = 6, scalar) readonly buffer EarlyLists { uint early_lists[]; };

layout(push_constant, scalar) uniform Push { uint shown_light; };  // index among the sorted lights; beyond them: none

const float kDarkened = 0.75;  // opacity of nothing over the picture

bool group_mask_holds(ivec2 tile) {
  ivec2 group = tile / GLOAM_TILE_GROUP;
  uint at = (uint(group.y) * grid.groups.x + uint(group.x)) * GLOAM_MASK_WORDS;
  uint word = shown_light >> 5;
  return (group_masks[at] >> word & 1u) != 0u && (group_masks[at + 1u + word] >> (shown_light & 31u) & 1u) != 0u;
}

// Whether the early list of a tile holds the light; of a tile whose list found no room, the mask that it is shaded from.
bool list_holds(ivec2 tile) {
  uvec2 list = texelFetch(tile_lists, tile, 0).xy;
  if (list.x == GLOAM_NO_SLOT) return list.y != 0u && group_mask_holds(tile);
  bool held = false;
  for (uint i = 0u; i < (list.y & 0xFFFFu) && !held; ++i) {
    uint entry = list.x + i;
    held = (early_lists[entry / 3u] >> (10u * (entry % 3u)) & 1023u) == shown_light;
  }
  return held;
}

// Whether the light gives anything at a pixel's surface. Looks at no list.
bool lights_pixel(LocalLight light, ivec2 pixel) {
  float depth = texelFetch(depth_image, pixel, 0).x;
  light.color = vec3(1.0);  // where it reaches counts, not its strength
  vec3 to_light;
  return depth > 0.0 && local_illuminance(light, relative_position(view, vec2(pixel), depth), to_light).x > 0.0;
}

#endif
