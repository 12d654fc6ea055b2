// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_Z_BINS_BINDING 5
#include "shaders/common/workgroup.glsl"
#include "shaders/lights/froxel_api.glsl"
#include "shaders/lights/z_bins_api.glsl"

// Find lights, approximate (FF XVI paper, listings 1 and 2): finds the lights that may touch the opaque surfaces of
// each shadow tile, and allocates its list. One workgroup per tile group, one thread per shadow tile. Unlike the paper,
// the masks of a group are combined in shared memory, not by subgroup operations: lanes may handle different words at
// the same time, and the code must not assume a subgroup size. The lights are first tested against the froxel of the
// whole group, then per tile.
//
// The counters must be 0 and farthest_depth 0x3F800000 before the first workgroup runs.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
layout(set = 0, binding = 2, scalar) uniform Grid { LightGrid grid; };
layout(set = 0, binding = 3) uniform sampler2D depth_bounds;
layout(set = 0, binding = 4) uniform sampler2D light_texels;
layout(set = 0, binding = 6, scalar) readonly buffer MaskTiles { uint mask_tiles[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer GroupMasks { uint group_masks[]; };
layout(set = 0, binding = 8, rg32ui) uniform writeonly uimage2D tile_lists;
layout(set = 0, binding = 9, scalar) buffer Counters { LightCounters counters; };

shared uint group_near;  // as bits: non-negative floats sort like their bits
shared uint group_far;
shared uint group_begin;  // union of the tiles' zBin ranges [begin, end) of sorted lights
shared uint group_end;
shared uint group_words[GLOAM_LIGHT_GROUPS];  // lights that touch the group's froxel
shared uint found_words[GLOAM_LIGHT_GROUPS];  // lights of group_words that touch the froxel of any tile
shared uint mask_sum, candidate_sum, approx_sum, tile_sum, overflow_sum, slot_base;

void clear_shared(uint lane) {
  if (lane < GLOAM_LIGHT_GROUPS) {
    group_words[lane] = 0u;
    found_words[lane] = 0u;
  }
  if (lane == 0u) {
    group_near = 0u;
    group_far = 0x3F800000u;
    group_begin = 0xFFFFu;
    group_end = 0u;
    mask_sum = candidate_sum = approx_sum = tile_sum = overflow_sum = 0u;
  }
}

// One word of the mask of a 32×32 tile. 0 if its group bit is 0: the stored word is then undefined.
uint mask_word(uint parent, uint word) {
  return (mask_tiles[parent] >> word & 1u) != 0u ? mask_tiles[parent + 1u + word] : 0u;
}

// One word of the union of the group's (up to four) tile masks.
uint parents_word(uint word) {
  uvec2 first = gl_WorkGroupID.xy * 2u;
  uvec2 last = min(first + 1u, grid.mask_tiles - 1u);
  uint bits = 0u;
  for (uint i = 0u; i < 4u; ++i) {
    uvec2 parent = uvec2((i & 1u) != 0u ? last.x : first.x, (i & 2u) != 0u ? last.y : first.y);
    bits |= mask_word((parent.y * grid.mask_tiles.x + parent.x) * uint(GLOAM_MASK_WORDS), word);
  }
  return bits;
}

// Each thread tests the lights of half a word against the froxel of the whole group.
void narrow_group(uint lane) {
  uint word = lane >> 1;
  uint half_word = (lane & 1u) != 0u ? 0xFFFF0000u : 0x0000FFFFu;
  uint left = word * 32u < grid.local_count
                  ? parents_word(word) & half_word & z_bin_bits(uvec2(group_begin, group_end), word)
                  : 0u;
  vec2 first = vec2(gl_WorkGroupID.xy * 64u);
  Froxel f = make_froxel(view, first, min(first + 64.0, vec2(view.size)), uintBitsToFloat(group_near),
                         uintBitsToFloat(group_far), 2.0 * kApproxEpsilon);
  uint found = 0u;
  for (; left != 0u; left &= left - 1u) {
    uint bit = uint(findLSB(left));
    if (touches(fetch_light(light_texels, word * 32u + bit), f)) found |= 1u << bit;
  }
  if (found != 0u) atomicOr(group_words[word], found);
}

// Finds the lights that touch the tile's froxel, adds them to found_words, and returns their number.
uint find_tile_lights(uvec2 tile, vec2 bounds, uvec2 range) {
  uint parent = ((tile.y >> 2) * grid.mask_tiles.x + (tile.x >> 2)) * uint(GLOAM_MASK_WORDS);
  vec2 first = vec2(tile * 8u);
  Froxel f = make_froxel(view, first, min(first + 8.0, vec2(view.size)), bounds.y, bounds.x, kApproxEpsilon);
  uint count = 0u, masked = 0u, candidates = 0u;
  for (uint word = 0u; word * 32u < grid.local_count; ++word) {
    uint mask = mask_word(parent, word);
    uint candidate = mask & z_bin_bits(range, word);
    masked += bitCount(mask);
    candidates += bitCount(candidate);
    uint found = 0u;
    for (uint left = candidate & group_words[word]; left != 0u; left &= left - 1u) {
      uint bit = uint(findLSB(left));
      if (touches(fetch_light(light_texels, word * 32u + bit), f)) found |= 1u << bit;
    }
    count += bitCount(found);
    if (found != 0u) atomicOr(found_words[word], found);
  }
  atomicAdd(mask_sum, masked);
  atomicAdd(candidate_sum, candidates);
  atomicAdd(approx_sum, count);
  return count;
}

// First list entry of the tile, or GLOAM_NO_SLOT.
uint allocate_slot(uvec2 tile, uint count, uint lane) {
  uint rounded = (count + 2u) / 3u * 3u;
  uint total;
  uint before = workgroup_prefix_sum(rounded, total);
  if (lane == 0u && total != 0u) slot_base = atomicAdd(counters.slots, total);
  barrier();
  uint slot = total != 0u ? slot_base + before : 0u;
  uint entries = rounded;
  if (grid.fixed_slots != 0u) {
    slot = (tile.y * grid.tiles.x + tile.x) * grid.fixed_slots;
    entries = max(rounded, grid.fixed_slots);
  }
  // Avoids a sum that could wrap.
  bool fits = slot <= grid.slot_capacity && entries <= grid.slot_capacity - slot &&
              (grid.fixed_slots == 0u || rounded <= grid.fixed_slots);
  if (count == 0u) return fits ? slot : 0u;
  if (fits) return slot;
  atomicAdd(overflow_sum, 1u);
  return GLOAM_NO_SLOT;
}

void write_group(uint lane) {
  uint base = (gl_WorkGroupID.y * grid.groups.x + gl_WorkGroupID.x) * uint(GLOAM_MASK_WORDS);
  if (lane < GLOAM_LIGHT_GROUPS) group_masks[base + 1u + lane] = found_words[lane];
  if (lane != 0u) return;
  uint groups = 0u, lights_found = 0u;
  for (uint word = 0u; word < GLOAM_LIGHT_GROUPS; ++word) {
    if (found_words[word] != 0u) groups |= 1u << word;
    lights_found += bitCount(found_words[word]);
  }
  group_masks[base] = groups;
  if (tile_sum == 0u) return;
  atomicAdd(counters.tiles, tile_sum);
  atomicAdd(counters.mask_lights, mask_sum);
  atomicAdd(counters.candidate_lights, candidate_sum);
  atomicAdd(counters.approx_lights, approx_sum);
  atomicAdd(counters.group_lights, lights_found * tile_sum);
  atomicMin(counters.farthest_depth, group_far);
  if (overflow_sum != 0u) atomicAdd(counters.overflow_tiles, overflow_sum);
}

void main() {
  uvec2 tile = gl_GlobalInvocationID.xy;
  bool inside = all(lessThan(tile, grid.tiles));
  uint lane = gl_LocalInvocationIndex;
  clear_shared(lane);
  barrier();
  vec2 bounds = texelFetch(depth_bounds, ivec2(min(tile, grid.tiles - 1u)), 0).xy;
  bool occupied = inside && bounds.y > 0.0;
  uvec2 range = uvec2(0xFFFFu, 0u);
  if (occupied) {
    range = z_bin_range(grid, surface_view_depth(view, bounds.y), surface_view_depth(view, bounds.x));
    atomicMax(group_near, floatBitsToUint(bounds.y));
    atomicMin(group_far, floatBitsToUint(bounds.x));
    atomicMin(group_begin, range.x);
    atomicMax(group_end, range.y);
    atomicAdd(tile_sum, 1u);
  }
  barrier();
  if (group_near > 0u) narrow_group(lane);
  barrier();
  uint count = 0u;
  if (occupied) count = find_tile_lights(tile, bounds, range);
  uint slot = allocate_slot(tile, count, lane);
  barrier();
  write_group(lane);
  if (inside) imageStore(tile_lists, ivec2(tile), uvec4(slot, count << 16, 0u, 0u));
}
