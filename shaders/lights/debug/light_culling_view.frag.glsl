// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_Z_BINS_BINDING 8
#include "shaders/lights/one_light_view_api.glsl"
#include "shaders/lights/z_bins_api.glsl"

// Visualizer of the last test that one light passes in each tile: the tile mask, the zBins of the tile's depths, the
// mask of the tile group, the tile's list. kLoud: the tile is shaded without the light although it reaches one of the
// tile's pixels.

layout(set = 0, binding = 7) uniform sampler2D depth_bounds;
layout(set = 0, binding = 9, scalar) readonly buffer MaskTiles { uint mask_tiles[]; };

bool mask_tile_holds(uvec2 pixel) {
  uint at = mask_tile_of(grid, pixel), word = shown_light >> 5;
  return (mask_tiles[at] >> word & 1u) != 0u && (mask_tiles[at + 1u + word] >> (shown_light & 31u) & 1u) != 0u;
}

bool z_bins_hold(uvec2 pixel) {
  vec2 bounds = texelFetch(depth_bounds, ivec2(pixel / GLOAM_SHADOW_TILE), 0).xy;
  if (bounds.y <= 0.0) return false;
  uvec2 range = z_bin_range(grid, surface_view_depth(view, bounds.y), surface_view_depth(view, bounds.x));
  return shown_light >= range.x && shown_light < range.y;
}

// Whether the light reaches any pixel of the pixel's tile. Independent of the lists.
bool lights_tile(uvec2 pixel) {
  LocalLight light = fetch_light(light_texels, shown_light);
  uvec2 first = pixel / GLOAM_SHADOW_TILE * GLOAM_SHADOW_TILE;
  bool lit = false;
  for (uint i = 0u; i < GLOAM_SHADOW_TILE * GLOAM_SHADOW_TILE && !lit; ++i)
    lit = lights_pixel(light, min(first + uvec2(i % GLOAM_SHADOW_TILE, i / GLOAM_SHADOW_TILE), view.size - 1u));
  return lit;
}

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  bool in_list = list_holds(pixel);
  if (!in_list && lights_tile(pixel)) {
    show(kLoud, kLoudOpacity);
    return;
  }
  vec3 color = vec3(0.0);
  if (mask_tile_holds(pixel)) {
    color = vec3(0.12);
    if (z_bins_hold(pixel)) {
      color = vec3(0.02, 0.08, 0.6);
      if (group_mask_holds(pixel)) color = in_list ? vec3(0.05, 0.6, 0.05) : vec3(0.7, 0.35, 0.0);
    }
  }
  show(with_grid(color, pixel, GLOAM_SHADOW_TILE), kDarkened);
}
