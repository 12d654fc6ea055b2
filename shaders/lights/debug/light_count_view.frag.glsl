// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/heat.glsl"
#include "shaders/lights/light_views_api.glsl"

// Visualizer of the number of lights per tile after one of the searches: heat colours for 0 to 31, white from 32.

layout(constant_id = 1) const uint kCount =
    0u;  // 0 tile masks, 1 approximate search, 2 accurate, 3 approximate minus accurate

layout(set = 0, binding = 0, scalar) uniform Grid { LightGrid grid; };
layout(set = 0, binding = 1, scalar) readonly buffer MaskTiles { uint mask_tiles[]; };
layout(set = 0, binding = 2) uniform usampler2D tile_lists;

int mask_count(uvec2 pixel) {
  uvec2 tile = pixel / GLOAM_LIGHT_TILE;
  uint at = (tile.y * grid.mask_tiles.x + tile.x) * GLOAM_MASK_WORDS;
  int count = 0;
  for (uint groups = mask_tiles[at]; groups != 0u; groups &= groups - 1u)
    count += bitCount(mask_tiles[at + 1u + uint(findLSB(groups))]);
  return count;
}

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  if (kCount == 0u) {
    int lights = mask_count(pixel);
    show_number(with_grid(heat(float(lights) / 31.0), pixel, GLOAM_LIGHT_TILE), 1.0, float(lights));
    return;
  }
  uint counts = texelFetch(tile_lists, ivec2(pixel / GLOAM_SHADOW_TILE), 0).y;
  int approx = int(counts >> 16), accurate = int(counts & 0xFFFFu);
  int count = kCount == 1u ? approx : kCount == 2u ? accurate : approx - accurate;
  show_number(with_grid(count < 0 ? kLoud : heat(float(count) / 31.0), pixel, GLOAM_SHADOW_TILE), 1.0, float(count));
}
