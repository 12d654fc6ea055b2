// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights/lists/find_lights_accurate.glsl"

// Find lights, accurate, for devices that run a workgroup's threads one after another. Gives the same lists as
// find_lights_accurate.comp.glsl with one thread per shadow tile instead of one per pixel. It needs no shared memory
// and no barrier. On these devices each barrier swaps the state of all threads, so avoiding barriers saves more time
// than testing pixels in parallel. One workgroup per tile group, so that its threads read the same mask.
//
// lavapipe limits the loop iterations of a thread to 65,535 in total: a light takes at most 21.

layout(local_size_x = 8, local_size_y = 8) in;

// Whether the light's volume contains a pixel of the tile. `probes`: four of the tile's points, which decide most
// cases.
bool reaches_tile(LocalLight light, uvec2 first, vec3 probes[4]) {
  bool reaches = false;
  for (uint i = 0u; i < 4u; ++i) reaches = reaches || in_range(light, probes[i]);
  for (uint i = 0u; i < 16u && !reaches; ++i) {
    uvec2 quad = first + 2u * uvec2(i & 3u, i >> 2);
    vec4 depths = textureGather(depth_image, vec2(quad + 1u) * view.inverse_size);
    reaches = in_range(light, point_at(quad + uvec2(0, 1), depths.x)) ||
              in_range(light, point_at(quad + uvec2(1, 1), depths.y)) ||
              in_range(light, point_at(quad + uvec2(1, 0), depths.z)) || in_range(light, point_at(quad, depths.w));
  }
  return reaches;
}

void main() {
  uvec2 tile = gl_GlobalInvocationID.xy;
  vec2 bounds = texelFetch(depth_bounds, ivec2(min(tile, grid.tiles - 1u)), 0).xy;
  bool occupied = all(lessThan(tile, grid.tiles)) && bounds.y > 0.0;
  uint mask = (gl_WorkGroupID.y * grid.groups.x + gl_WorkGroupID.x) * uint(GLOAM_MASK_WORDS);
  uint groups = occupied ? group_masks[mask] : 0u;
  if (groups == 0u) return;

  uvec2 first = tile * uint(GLOAM_SHADOW_TILE);
  vec3 probes[4];
  for (uint i = 0u; i < 4u; ++i) probes[i] = pixel_point(first + 1u + uvec2(i & 1u, i >> 1) * 5u);
  Froxel f =
      make_froxel(view, vec2(first), min(vec2(first + 8u), vec2(view.size)), bounds.y, bounds.x, kAccurateEpsilon);
  uvec2 tile_list = imageLoad(tile_lists, ivec2(tile)).xy;
  uint room = tile_list.x == GLOAM_NO_SLOT ? 0u : ((tile_list.y >> 16) + 2u) / 3u * 3u;
  uint total = 0u, packed = 0u;
  for (; groups != 0u; groups &= groups - 1u) {
    uint word = uint(findLSB(groups));
    for (uint left = group_masks[mask + 1u + word]; left != 0u; left &= left - 1u) {
      uint index = word * 32u + uint(findLSB(left));
      LocalLight light = fetch_light(light_texels, index);
      if (!touches(light, f)) continue;
      if (!reaches_tile(light, first, probes)) continue;
      packed |= index << 10u * (total % 3u);
      if (total < room && total % 3u == 2u) early_lists[(tile_list.x + total) / 3u] = packed;
      if (total % 3u == 2u) packed = 0u;
      ++total;
    }
  }
  if (total < room && total % 3u != 0u) early_lists[(tile_list.x + total) / 3u] = packed;
  uint entries = ((tile_list.y >> 16) + 2u) / 3u * 3u;
  imageStore(tile_lists, ivec2(tile), uvec4(tile_list.x, (tile_list.y & 0xFFFF0000u) | min(total, entries), 0u, 0u));
  if (total > 0u) atomicAdd(counters.accurate_lights, total);
  if (total > entries) atomicAdd(counters.violations, total - entries);
}
