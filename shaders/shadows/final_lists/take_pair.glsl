// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_TAKE_PAIR_GLSL
#define GLOAM_SHADERS_SHADOWS_TAKE_PAIR_GLSL

#include "shaders/shadows/final_lists/pair_places.glsl"

// Makes a tile-light pair of an entry. Returns the slot that the entry holds until the pair is filtered: the tile's
// index, or GLOAM_NO_ROOM when the buffer of pairs is full. Uses the buffers that the shaders which make pairs declare:
// final_grid, counters, commands and pairs. entry: its index, with GLOAM_DIM_LIGHT if its light is dim.
uint take_pair(uint entry, uint tile_index, uint kind) {
  if (atomicAdd(counters.pairs, 1u) >= final_grid.pair_capacity) return GLOAM_NO_ROOM;
  uint pair = atomicAdd(commands.pairs[kind].w, 1u);
  pairs[pair_place(final_grid, kind, pair)] = entry;
  if (kDimLights != 0u && (entry & GLOAM_DIM_LIGHT) != 0u) atomicAdd(counters.dim, 1u);
  if (pair % GLOAM_PAIRS_ROW == 0u) atomicMax(commands.pairs[kind].y, pair / GLOAM_PAIRS_ROW + 1u);
  return tile_index;
}

#endif
