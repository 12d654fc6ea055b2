// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_PAIR_PLACES_GLSL
#define GLOAM_SHADERS_SHADOWS_PAIR_PLACES_GLSL

#include "shaders/shadows/final_lists_shared.h"

// Index in the buffer of pairs of the pair with number `pair` of its kind. All kinds together have at most
// pair_capacity pairs.
uint pair_place(FinalGrid grid, uint kind, uint pair) {
  uint end = grid.pair_capacity;
  return kind == uint(GLOAM_PAIRS_IN_FACE) ? pair : kind == uint(GLOAM_PAIRS_CROSSING) ? end - 1u - pair : end + pair;
}

// The same for candidates. All local ones together are at most candidate_capacity, and all directional ones.
uint candidate_place(FinalGrid grid, uint kind, uint candidate) {
  bool two = (kind & uint(GLOAM_CANDIDATES_TWO_GROUPS)) != 0u;
  uint end = grid.candidate_capacity;
  if ((kind & uint(GLOAM_CANDIDATES_DIRECTIONAL)) == 0u) return two ? end - 1u - candidate : candidate;
  uint most = min(end, grid.tiles.x * grid.tiles.y * grid.directional_count);
  return two ? end + most - 1u - candidate : end + candidate;
}

#endif
