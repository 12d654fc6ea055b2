// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_FINISH_GLSL
#define GLOAM_SHADERS_SHADOWS_FINISH_GLSL

#include "shaders/shadows/final_lists_shared.h"

// Removes GLOAM_ALL_UNLIT entries from final lists, and collects the fallback tiles. With GLOAM_SHADOWS_KEEP, notes
// each tile's list for the next frame. Each thread processes one tile.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform Grid { FinalGrid final_grid; };
layout(set = 0, binding = 1, rgba32ui) uniform uimage2D final_tiles;
layout(set = 0, binding = 2, scalar) buffer Entries { uint entries[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer FallbackTiles { uint fallback_tiles[]; };
layout(set = 0, binding = 4, scalar) buffer Counters { ShadowListCounters counters; };
layout(set = 0, binding = 5, scalar) buffer Commands { ShadowListCommands commands; };
#ifdef GLOAM_SHADOWS_KEEP
layout(set = 0, binding = 6, scalar) buffer KeptTiles { KeptTile kept_tiles[]; };

// complete: the tile has a list. counts: z of its texel.
void note_list(uint tile_index, bool complete, uvec2 firsts, uint counts) {
  bool reusable = complete && kept_tiles[tile_index].key != uvec4(0u);
  kept_tiles[tile_index].directional_first = reusable ? firsts.x : GLOAM_NO_FINAL_LIST;
  kept_tiles[tile_index].local_first = reusable ? firsts.y : GLOAM_NO_FINAL_LIST;
  kept_tiles[tile_index].counts = counts;
}
#else
void note_list(uint tile_index, bool complete, uvec2 firsts, uint counts) {}
#endif

// Moves the entries that stay to the start of their run and returns their number. complete: set to false if an entry
// has GLOAM_NO_ROOM.
uint pack_run(uint first, uint count, inout bool complete) {
  uint kept = 0u;
  for (uint i = 0u; i < count; ++i) {
    uint entry = entries[first + i], slot = entry >> 10;
    complete = complete && slot != GLOAM_NO_ROOM;
    if (slot == GLOAM_ALL_UNLIT) continue;
    if (kept != i) entries[first + kept] = entry;
    ++kept;
  }
  return kept;
}

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(at, final_grid.tiles))) return;
  uvec3 list = imageLoad(final_tiles, ivec2(at)).xyz;
  bool complete = list.y != GLOAM_NO_FINAL_LIST;
  uint directional = pack_run(list.x, list.z >> 16, complete);
  uint local = pack_run(list.y, list.z & 0xFFFFu, complete);
  uint counts = directional << 16 | local;
  if (!complete) {
    fallback_tiles[atomicAdd(commands.fallback_draw.y, 1u)] = at.y << 16 | at.x;
    atomicAdd(counters.fallback_tiles, 1u);
    list.xy = uvec2(GLOAM_NO_FINAL_LIST);
    counts = 0u;
  }
  if (counts != list.z || !complete) imageStore(final_tiles, ivec2(at), uvec4(list.xy, counts, 0u));
  note_list(at.y * final_grid.tiles.x + at.x, complete, list.xy, counts);
}

#endif
