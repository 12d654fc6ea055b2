// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_OPAQUE_DEFERRED_TILE_LIGHTS_GLSL
#define GLOAM_SHADERS_LIGHTING_OPAQUE_DEFERRED_TILE_LIGHTS_GLSL

#include "shaders/lighting/opaque/deferred.glsl"
#include "shaders/lights/light_lists_api.glsl"

// Deferred lighting with early lists: every pixel loops over the early list of its shadow tile, or over the group mask
// if the list did not fit.

layout(set = 0, binding = 9, scalar) uniform Grid { LightGrid grid; };
layout(set = 0, binding = 10) uniform usampler2D tile_lists;
layout(set = 0, binding = 12, scalar) readonly buffer GroupMasks { uint group_masks[]; };

// 1: every tile has a list. Otherwise software devices run the loop over the group mask for every pixel, needed or not.
layout(constant_id = 2) const uint kAlwaysFit = 0u;

vec3 group_lights(ShadingPoint p, uvec2 pixel) {
  vec3 sum = vec3(0.0);
  uint mask = group_mask_of(grid, pixel);
  for (uint groups = group_masks[mask]; groups != 0u; groups &= groups - 1u) {
    uint word = uint(findLSB(groups));
    for (uint bits = group_masks[mask + 1u + word]; bits != 0u; bits &= bits - 1u)
      sum += add_local(p, word * 32u + uint(findLSB(bits)), 1.0);
  }
  return sum;
}

vec3 local_lights(ShadingPoint p, uvec2 pixel) {
  vec3 sum = vec3(0.0);
  uvec2 tile_list = texelFetch(tile_lists, ivec2(pixel / uint(GLOAM_SHADOW_TILE)), 0).xy;
  bool listed = kAlwaysFit != 0u || has_list(tile_list);
  uint count = listed ? list_count(tile_list) : 0u;
  // Reads the entries like list_light, but without its divisions.
  uint at = tile_list.x / 3u, shift = 0u;
  // The loop tests its condition at the end: software devices run the body once more when a test at the start fails.
  uint i = 0u;
  if (count > 0u) do {
      sum += add_local(p, bitfieldExtract(early_lists[at], int(shift), 10), 1.0);
      shift += 10u;
      at += shift / 30u;
      shift = shift == 30u ? 0u : shift;
    } while (++i < count);
  if (!listed) sum += group_lights(p, pixel);
  return sum;
}

#endif
