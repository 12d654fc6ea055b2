// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights/one_light_view.glsl"

// How far one light got in each tile: the CPU's mask tile, the zBins of the tile's depths, the mask of the tile group, the tile's list.
// Loud: the tile does not look at the light although it reaches one of the tile's pixels.

layout(set = 0, binding = 7) uniform sampler2D depth_bounds;
layout(set = 0, binding = 8, scalar) readonly buffer ZBins { uint z_bins[]; };
layout(set = 0, binding = 9, scalar) readonly buffer MaskTiles { uint mask_tiles[]; };

bool mask_tile_holds(ivec2 mask_tile) {
  uint at = (uint(mask_tile.y) * grid.mask_tiles.x + uint(mask_tile.x)) * GLOAM_MASK_WORDS;
  uint word = shown_light >> 5;
  return (mask_tiles[at] >> word & 1u) != 0u && (mask_tiles[at + 1u + word] >> (shown_light & 31u) & 1u) != 0u;
}

uint z_bin_of(ivec2 tile, float depth) {
  float metres = view_depth(view, relative_position(view, vec2(tile * GLOAM_SHADOW_TILE), depth));
  return uint(clamp((metres - grid.z_near) * grid.z_scale, 0.0, float(grid.z_bin_count - 1u)));
}

bool z_bins_hold(ivec2 tile) {
  vec2 bounds = texelFetch(depth_bounds, tile, 0).xy;
  if (bounds.y <= 0.0) return false;
  uint first = z_bin_of(tile, bounds.y), last = z_bin_of(tile, bounds.x);
  uint ranged = last - first > 1u ? grid.z_bin_count : 0u;
  return shown_light >= (z_bins[ranged + first] & 0xFFFFu) && shown_light < z_bins[ranged + last] >> 16;
}

bool lights_tile(ivec2 tile) {
  LocalLight light = fetch_light(light_texels, shown_light);
  bool lit = false;
  for (int i = 0; i < GLOAM_SHADOW_TILE * GLOAM_SHADOW_TILE && !lit; ++i) {
    ivec2 pixel = tile * GLOAM_SHADOW_TILE + ivec2(i % GLOAM_SHADOW_TILE, i / GLOAM_SHADOW_TILE);
    lit = lights_pixel(light, min(pixel, ivec2(view.size) - 1));
  }
  return lit;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (shown_light >= grid.local_count) {
    show(vec3(0.0), kDarkened);
    return;
  }
  ivec2 tile = pixel / GLOAM_SHADOW_TILE;
  bool held = list_holds(tile);
  vec3 color = vec3(0.0);
  if (mask_tile_holds(pixel / GLOAM_LIGHT_TILE)) {
    color = vec3(0.12);
    if (z_bins_hold(tile)) {
      color = vec3(0.02, 0.08, 0.6);
      if (group_mask_holds(tile)) color = held ? vec3(0.05, 0.6, 0.05) : vec3(0.7, 0.35, 0.0);
    }
  }
  if (!held && lights_tile(tile)) {
    show(kLoud, 0.95);
    return;
  }
  show(with_grid(color, pixel, GLOAM_SHADOW_TILE), kDarkened);
}
