// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/common/heat.glsl"
#include "shaders/lights/light_views.glsl"

// How many lights each tile has after one of the searches: heat colours of 0 to 31, white from 32 on.

layout(constant_id = 1) const uint kCount = 0u;  // 0 CPU's mask tiles, 1 approximate, 2 accurate, 3 approximate less accurate

layout(set = 0, binding = 0, scalar) uniform Grid { LightGrid grid; };
layout(set = 0, binding = 1, scalar) readonly buffer MaskTiles { uint mask_tiles[]; };
layout(set = 0, binding = 2) uniform usampler2D tile_lists;

int mask_count(ivec2 mask_tile) {
  uint at = (uint(mask_tile.y) * grid.mask_tiles.x + uint(mask_tile.x)) * GLOAM_MASK_WORDS;
  int count = 0;
  for (uint groups = mask_tiles[at]; groups != 0u; groups &= groups - 1u) count += bitCount(mask_tiles[at + 1u + uint(findLSB(groups))]);
  return count;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (kCount == 0u) {
    vec3 color = heat(float(mask_count(pixel / GLOAM_LIGHT_TILE)) / 31.0);
    show(with_grid(color, pixel, GLOAM_LIGHT_TILE), 1.0);
    return;
  }
  uint counts = texelFetch(tile_lists, pixel / GLOAM_SHADOW_TILE, 0).y;
  int approx = int(counts >> 16), accurate = int(counts & 0xFFFFu);
  int count = kCount == 1u ? approx : kCount == 2u ? accurate : approx - accurate;
  vec3 color = count < 0 ? kLoud : heat(float(count) / 31.0);
  show(with_grid(color, pixel, GLOAM_SHADOW_TILE), 1.0);
}
