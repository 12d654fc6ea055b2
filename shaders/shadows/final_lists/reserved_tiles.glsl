// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_RESERVED_TILES_GLSL
#define GLOAM_SHADERS_SHADOWS_RESERVED_TILES_GLSL

#include "shaders/shadows/slots_api.glsl"

// Slots of reserved and of other tiles. Include this after declaring `reserved_tiles` as well: bit i % 32 of word i /
// 32 for tile i; one word if no tile is reserved.

bool is_reserved(uint tile_index) {
  bool any_is = final_grid.reserved_slots != 0u;
  return any_is && (reserved_tiles[any_is ? tile_index >> 5 : 0u] >> (tile_index & 31u) & 1u) != 0u;
}

// Takes a slot for a light of this tile; GLOAM_NO_ROOM if none is left.
uint take_free_slot_of(uint tile_index) { return take_free_slot(is_reserved(tile_index)); }

#endif
