// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights/lists/find_lights_accurate.glsl"

// Find lights, accurate (FF XVI paper, listing 3): lists, in ascending order, the lights of each shadow tile whose
// volume contains one of its pixels. One workgroup per tile. First the lights of the tile group are tested against the
// tile's froxel, different lights per thread. Then every pixel is tested against the remaining lights; one OR over the
// workgroup gives the result for 32 lights.
//
// Unlike the paper, each thread handles 8 / kRows pixels. Fewer rows mean fewer threads. That makes the stages that do
// not work on pixels cheaper on a software rasterizer, which runs each stage for every thread, even for threads without
// work. lavapipe limits the loop iterations of a thread to 65,535 in total, so no stage takes more than one iteration
// per light and word.

layout(local_size_x = 8, local_size_y = 2, local_size_y_id = 0) in;  // constant 0: rows of threads; 1, 2, 4 or 8

const uint kRows = gl_WorkGroupSize.y;
const uint kThreads = 8u * kRows;
const uint kPixels = 8u / kRows;

shared uint near_count;  // lights whose range touches the tile's froxel
shared uint open_count;  // lights of near_count that pixels are tested against ("open" lights)
shared uint found_count;
shared uint open_groups;                          // bit w: open_words[w] is not 0
shared uint near_lights[GLOAM_MAX_LOCAL_LIGHTS];  // unordered
shared uint open_words[GLOAM_LIGHT_GROUPS];
shared uint open_lights[GLOAM_MAX_LOCAL_LIGHTS];  // ascending
shared uint open_hits[GLOAM_LIGHT_GROUPS];        // bit i: open light i reaches a pixel
shared uint packed_list[(GLOAM_MAX_LOCAL_LIGHTS + 2) / 3];

// Tests the lights in one word of the group's mask against the froxel.
void find_near(Froxel f, uint mask, uint word) {
  uint left = (group_masks[mask] >> word & 1u) != 0u ? group_masks[mask + 1u + word] : 0u;
  uint touching = 0u;
  for (; left != 0u; left &= left - 1u) {
    uint bit = uint(findLSB(left));
    vec4 sphere = texelFetch(light_texels, ivec2(0, word * 32u + bit), 0);
    if (sphere_touches(sphere.xyz * f.view_axes, sphere.w, f)) touching |= 1u << bit;
  }
  if (touching == 0u) return;
  uint next = atomicAdd(near_count, bitCount(touching));
  for (; touching != 0u; touching &= touching - 1u) near_lights[next++] = word * 32u + uint(findLSB(touching));
}

void test_cones(Froxel f, uint lane) {
  for (uint i = lane; i < near_count; i += kThreads) {
    uint light = near_lights[i];
    if (!cone_touches(fetch_light(light_texels, light), f)) continue;
    atomicAdd(open_count, 1u);
    atomicOr(open_words[light >> 5], 1u << (light & 31u));
    atomicOr(open_groups, 1u << (light >> 5));
  }
}

// Sorts the open lights: the position of a light is the number of open lights with a lower index.
void sort_open(uint lane) {
  for (uint i = lane; i < near_count; i += kThreads) {
    uint light = near_lights[i];
    uint word = light >> 5;
    uint below = (1u << (light & 31u)) - 1u;
    uint rank = bitCount(open_words[word] & below);
    for (uint left = open_groups & ((1u << word) - 1u); left != 0u; left &= left - 1u)
      rank += bitCount(open_words[findLSB(left)]);
    if ((open_words[word] >> (light & 31u) & 1u) != 0u) open_lights[rank] = light;
  }
}

void ask_pixels(uvec2 pixel, uint lane) {
  vec3 points[8];
  float slacks[8];
  for (uint p = 0u; p < kPixels; ++p) {
    points[p] = pixel_point(pixel + uvec2(0u, p * kRows));
    slacks[p] = point_slack(points[p]);
  }
  uint count = open_count;
  for (uint base = 0u; base < count; base += 32u) {
    uint hits = 0u;
    uint end = min(count - base, 32u);
    for (uint i = 0u; i < end; ++i) {
      LocalLight light = fetch_light(light_texels, open_lights[base + i]);
      for (uint p = 0u; p < kPixels; ++p) hits |= uint(in_range(light, points[p], slacks[p])) << i;
    }
    if ((hits & ~open_hits[base >> 5]) != 0u) atomicOr(open_hits[base >> 5], hits);
  }
  for (uint i = lane; i * 3u < count; i += kThreads) packed_list[i] = 0u;
}

void pack_hits(uint lane) {
  uint count = open_count;
  uint found = 0u;
  for (uint base = 0u; base < count; base += 32u) {
    uint hits = open_hits[base >> 5];
    for (uint bit = lane; bit < 32u; bit += kThreads) {
      if ((hits >> bit & 1u) == 0u) continue;
      uint entry = found + bitCount(hits & ((1u << bit) - 1u));
      atomicOr(packed_list[entry / 3u], open_lights[base + bit] << 10u * (entry % 3u));
    }
    found += bitCount(hits);
  }
  if (lane == 0u) found_count = found;
}

void write_list(uvec2 tile, uvec2 tile_list, uint lane) {
  uint found = found_count;
  uint room = ((tile_list.y >> 16) + 2u) / 3u * 3u;
  uint count = min(found, room);
  if (tile_list.x != GLOAM_NO_SLOT)
    for (uint i = lane; i * 3u < count; i += kThreads) early_lists[tile_list.x / 3u + i] = packed_list[i];
  if (lane != 0u || found == 0u) return;
  imageStore(tile_lists, ivec2(tile), uvec4(tile_list.x, (tile_list.y & 0xFFFF0000u) | count, 0u, 0u));
  atomicAdd(counters.accurate_lights, found);
  if (found > room) atomicAdd(counters.violations, found - room);
}

void main() {
  uvec2 tile = gl_WorkGroupID.xy;
  uint lane = gl_LocalInvocationIndex;
  vec2 bounds = texelFetch(depth_bounds, ivec2(tile), 0).xy;
  uvec2 group = tile / uint(GLOAM_TILE_GROUP);
  uint mask = (group.y * grid.groups.x + group.x) * uint(GLOAM_MASK_WORDS);
  if (bounds.y <= 0.0 || group_masks[mask] == 0u) return;  // uniform over the workgroup

  for (uint word = lane; word < GLOAM_LIGHT_GROUPS; word += kThreads) open_words[word] = open_hits[word] = 0u;
  if (lane == 0u) near_count = open_count = open_groups = 0u;
  barrier();
  vec2 first = vec2(tile * uint(GLOAM_SHADOW_TILE));
  Froxel f = make_froxel(view, first, min(first + float(GLOAM_SHADOW_TILE), vec2(view.size)), bounds.y, bounds.x,
                         kAccurateEpsilon);
  for (uint word = lane; word < GLOAM_LIGHT_GROUPS; word += kThreads) find_near(f, mask, word);
  barrier();
  test_cones(f, lane);
  barrier();
  sort_open(lane);
  barrier();
  ask_pixels(tile * uint(GLOAM_SHADOW_TILE) + gl_LocalInvocationID.xy, lane);
  barrier();
  pack_hits(lane);
  uvec2 tile_list = imageLoad(tile_lists, ivec2(tile)).xy;
  barrier();
  write_list(tile, tile_list, lane);
}
