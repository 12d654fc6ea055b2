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

#endif
