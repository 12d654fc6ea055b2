// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_FORWARD_TILE_LIGHTS_GLSL
#define GLOAM_SHADERS_LIGHTING_FORWARD_TILE_LIGHTS_GLSL

#include "shaders/lighting/forward.glsl"
#include "shaders/lights/z_bins_api.glsl"

// Forward lighting with tile masks and zBins: every fragment loops over the lights of its tile mask that are in the
// zBin of its own depth. Early lists hold only lights at opaque depths.

layout(set = 0, binding = 3, scalar) uniform Grid { LightGrid grid; };
layout(set = 0, binding = 4) uniform sampler2D light_texels;
layout(set = 0, binding = 6, scalar) readonly buffer MaskTiles { uint mask_tiles[]; };

vec3 add_local_of(ShadingPoint p, uint index) { return add_local(p, index, fetch_light(light_texels, index)); }

vec3 local_lights(ShadingPoint p) {
  vec3 sum = vec3(0.0);
  float depth_m = view_depth(view, p.position);
  uvec2 range = z_bin_range(grid, depth_m, depth_m);
  uvec2 tile = uvec2(gl_FragCoord.xy) / uint(GLOAM_LIGHT_TILE);
  uint mask = (tile.y * grid.mask_tiles.x + tile.x) * uint(GLOAM_MASK_WORDS);
  uint words = range.x < range.y ? z_bin_bits(uvec2(range.x >> 5, (range.y + 31u) >> 5), 0u) : 0u;
  for (uint groups = mask_tiles[mask] & words; groups != 0u; groups &= groups - 1u) {
    uint word = uint(findLSB(groups));
    for (uint bits = mask_tiles[mask + 1u + word] & z_bin_bits(range, word); bits != 0u; bits &= bits - 1u)
      sum += add_local_of(p, word * 32u + uint(findLSB(bits)));
  }
  return sum;
}

#endif
