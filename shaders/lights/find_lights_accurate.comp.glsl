// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights/froxel_api.glsl"

// Find lights, accurate (FF XVI paper, listing 3): the lights of each shadow tile that have a pixel of it in their volume, in ascending
// order. One workgroup is a tile. First each thread narrows the lights of the group's mask against the tile's froxel and accepts those
// that reach one of four probe pixels; then the workgroup asks all pixels about what is left.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2, scalar) uniform Grid { LightGrid grid; };
layout(set = 0, binding = 3) uniform sampler2D depth_image;
layout(set = 0, binding = 4) uniform sampler2D light_texels;
layout(set = 0, binding = 5) uniform sampler2D depth_bounds;
layout(set = 0, binding = 6, scalar) readonly buffer GroupMasks { uint group_masks[]; };
layout(set = 0, binding = 7, rg32ui) uniform uimage2D tile_lists;
layout(set = 0, binding = 8, scalar) writeonly buffer EarlyLists { uint early_lists[]; };
layout(set = 0, binding = 9, scalar) buffer Counters { LightCounters counters; };

shared vec4 points[64];  // of the tile's pixels, camera-relative; w 0: sky or outside the picture
shared uint words[GLOAM_LIGHT_GROUPS];  // lights found
shared uint open_count;                 // lights that no probe decided
shared uint open_lights[GLOAM_MAX_LOCAL_LIGHTS];
shared uint open_hits[GLOAM_LIGHT_GROUPS];  // bit i: open light i reaches a pixel
shared uint list[GLOAM_MAX_LOCAL_LIGHTS];

vec4 pixel_point(uvec2 pixel) {
  float depth = texelFetch(depth_image, ivec2(min(pixel, view.size - 1u)), 0).r;
  bool valid = depth > 0.0 && all(lessThan(pixel, view.size));
  return vec4(relative_position(view, vec2(pixel), valid ? depth : 1.0), valid ? 1.0 : 0.0);
}

bool reaches_probe(LocalLight light) {
  for (uint i = 0u; i < 4u; ++i) {
    vec4 point = points[9u + (i & 1u) * 5u + (i >> 1) * 40u];  // the corners but for one pixel
    if (point.w != 0.0 && in_range(light, point.xyz)) return true;
  }
  return false;
}

// Each thread decides the lights of half a word, as far as it can.
void narrow(uvec2 tile, vec2 bounds, uint mask, uint lane) {
  uint word = lane >> 1;
  uint half_word = (lane & 1u) != 0u ? 0xFFFF0000u : 0x0000FFFFu;
  uint left = (group_masks[mask] >> word & 1u) != 0u ? group_masks[mask + 1u + word] & half_word : 0u;
  vec2 first = vec2(tile * 8u);
  Froxel f = make_froxel(view, first, min(first + 8.0, vec2(view.size)), bounds.y, bounds.x, kAccurateEpsilon);
  uint found = 0u;
  for (; left != 0u; left &= left - 1u) {
    uint bit = uint(findLSB(left));
    uint index = word * 32u + bit;
    LocalLight light = fetch_light(light_texels, index);
    if (!touches(light, f)) continue;
    if (reaches_probe(light)) {
      found |= 1u << bit;
    } else {
      open_lights[atomicAdd(open_count, 1u)] = index;
    }
  }
  if (found != 0u) atomicOr(words[word], found);
}

// Every pixel's answer about the open lights: one mask and one OR for 32 of them.
void ask_pixels(vec4 point) {
  for (uint base = 0u; base < open_count; base += 32u) {
    uint hits = 0u;
    uint count = min(open_count - base, 32u);
    for (uint i = 0u; i < count; ++i)
      if (in_range(fetch_light(light_texels, open_lights[base + i]), point.xyz)) hits |= 1u << i;
    if (point.w != 0.0 && hits != 0u) atomicOr(open_hits[base >> 5], hits);
  }
}

void accept_hits(uint lane) {
  for (uint i = lane; i < open_count; i += 64u) {
    if ((open_hits[i >> 5] >> (i & 31u) & 1u) == 0u) continue;
    uint index = open_lights[i];
    atomicOr(words[index >> 5], 1u << (index & 31u));
  }
}

// The found lights in ascending order into `list`; returns how many.
uint expand(uint lane) {
  uint total = 0u, before = 0u;
  for (uint word = 0u; word < GLOAM_LIGHT_GROUPS; ++word) {
    if (word == lane) before = total;
    total += bitCount(words[word]);
  }
  if (lane < GLOAM_LIGHT_GROUPS)
    for (uint left = words[lane]; left != 0u; left &= left - 1u) list[before++] = lane * 32u + uint(findLSB(left));
  return total;
}

void main() {
  uvec2 tile = gl_WorkGroupID.xy;
  uint lane = gl_LocalInvocationIndex;
  vec2 bounds = texelFetch(depth_bounds, ivec2(tile), 0).xy;
  uvec2 group = tile / uint(GLOAM_TILE_GROUP);
  uint mask = (group.y * grid.groups.x + group.x) * uint(GLOAM_MASK_WORDS);
  if (bounds.y <= 0.0 || group_masks[mask] == 0u) return;  // the same for the whole workgroup

  vec4 point = pixel_point(gl_GlobalInvocationID.xy);
  points[lane] = point;
  if (lane < GLOAM_LIGHT_GROUPS) {
    words[lane] = 0u;
    open_hits[lane] = 0u;
  }
  if (lane == 0u) open_count = 0u;
  barrier();
  narrow(tile, bounds, mask, lane);
  barrier();
  if (open_count != 0u) {
    ask_pixels(point);
    barrier();
    accept_hits(lane);
    barrier();
  }
  uint total = expand(lane);
  barrier();

  uvec2 tile_list = imageLoad(tile_lists, ivec2(tile)).xy;
  uint room = ((tile_list.y >> 16) + 2u) / 3u * 3u;
  uint count = min(total, room);
  if (tile_list.x != GLOAM_NO_SLOT) {
    for (uint i = lane; i * 3u < count; i += 64u) {
      uint entry = i * 3u;
      uint packed = list[entry];
      if (entry + 1u < count) packed |= list[entry + 1u] << 10;
      if (entry + 2u < count) packed |= list[entry + 2u] << 20;
      early_lists[tile_list.x / 3u + i] = packed;
    }
  }
  if (lane != 0u) return;
  imageStore(tile_lists, ivec2(tile), uvec4(tile_list.x, (tile_list.y & 0xFFFF0000u) | count, 0u, 0u));
  if (total > 0u) atomicAdd(counters.accurate_lights, total);
  if (total > room) atomicAdd(counters.violations, total - room);
}
