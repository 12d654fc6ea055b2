// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_LIGHT_LISTS_API_GLSL
#define GLOAM_SHADERS_LIGHTS_LIGHT_LISTS_API_GLSL

#include "shaders/lights/lights_shared.h"

// Access to early lists and light masks. Before including this, define GLOAM_EARLY_LISTS_BINDING. `tile_list` is the
// tile's texel of LightsOutputs::tile_lists. Lists are sorted by light index.
//   for (uint i = 0u; i < list_count(tile_list); ++i) shade(list_light(tile_list.x, i));

layout(set = 0, binding = GLOAM_EARLY_LISTS_BINDING, scalar) readonly buffer EarlyLists { uint early_lists[]; };

// False: the tile uses the lights of its group's mask.
bool has_list(uvec2 tile_list) { return tile_list.x != GLOAM_NO_SLOT; }

// Lights whose volume contains a pixel of the tile. Valid also without a list.
uint list_count(uvec2 tile_list) { return tile_list.y & 0xFFFFu; }

// Lights that touch the tile's froxel.
uint approx_count(uvec2 tile_list) { return tile_list.y >> 16; }

// Entry i of the list that starts at `slot`.
uint list_light(uint slot, uint i) {
  uint entry = slot + i;
  return bitfieldExtract(early_lists[entry / 3u], int(10u * (entry % 3u)), 10);
}

// First word of the mask of a pixel's tile group in LightsOutputs::group_masks.
uint group_mask_of(LightGrid grid, uvec2 pixel) {
  uvec2 group = pixel / uint(GLOAM_SHADOW_TILE * GLOAM_TILE_GROUP);
  return (group.y * grid.groups.x + group.x) * uint(GLOAM_MASK_WORDS);
}

// First word of the mask of a pixel's 32×32 tile in LightsOutputs::mask_tiles.
uint mask_tile_of(LightGrid grid, uvec2 pixel) {
  uvec2 tile = pixel / uint(GLOAM_LIGHT_TILE);
  return (tile.y * grid.mask_tiles.x + tile.x) * uint(GLOAM_MASK_WORDS);
}

#endif
