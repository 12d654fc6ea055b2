// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_FINAL_LISTS_SHARED_H
#define GLOAM_SHADERS_SHADOWS_FINAL_LISTS_SHARED_H

#include "shaders/common/prelude.h"

// Final light lists (shadows.mode = deferred): what lights a shadow tile, and how much of each light its pixels see.
//
// A tile's entries lie in two runs: directional lights, local ones, both in ascending order. An entry is 10 bits of
// light (index among the view's directional or local lights) and 22 bits of slot: a slot of visibilities, GLOAM_ALL_LIT
// (every pixel sees all of it; so does every pixel of a light without shadows) or GLOAM_ALL_UNLIT (none sees any; no
// finished list holds it). A slot is 64 visibilities, row by row, of 8 or 4 bits: words of four or eight, the first
// pixel in the lowest bits.
//
// One texel a tile (rgba32ui): x its first directional entry, y its first local one, or GLOAM_NO_FINAL_LIST in both
// where a buffer was full: the tile is shaded from early lists or its group's mask and from shadow maps. z: local
// entries in the low 16 bits, directional ones in the high 16.

#define GLOAM_ALL_LIT 0x3FFFFEu
#define GLOAM_ALL_UNLIT 0x3FFFFFu
#define GLOAM_NO_ROOM 0x3FFFFDu  // of an entry, until its tile's list is finished: no slot was left for it
#define GLOAM_NO_FINAL_LIST 0xFFFFFFFFu
#define GLOAM_SLOT_PIXELS 64
#define GLOAM_VISIBILITY_BUFFERS 2    // that slots are spread over, in order
#define GLOAM_BUFFER_WORDS 33554432u  // of one of them: 128 MiB
// Kinds of pairs, each with a shader of its own. Pairs lie in one buffer: those in one face from its begin, crossing
// ones from pair_capacity backwards, directional ones, of which a tile has no more than the view, from there on.
#define GLOAM_PAIRS_IN_FACE 0   // local lights, all that their pixels look at lies in one face
#define GLOAM_PAIRS_CROSSING 1  // of cubes, other faces may have part in it
#define GLOAM_PAIRS_DIRECTIONAL 2
#define GLOAM_PAIR_KINDS 3
#define GLOAM_PAIRS_ROW 256  // workgroups of a row of the dispatch over pairs

GLOAM_SHARED_BEGIN

/// How the view's final lists lie in their buffers.
struct FinalGrid {
  uvec2 tiles;             // shadow tiles
  uint directional_count;  // lights; the first tiles.x · tiles.y times as many entries are theirs
  uint has_early_lists;    // 0: the view has no local lights
  uint entry_capacity;
  uint pair_capacity;
  uint slot_capacity;
  uint classify;  // 0: every light that casts shadows is asked about at every pixel
};

/// Arguments of indirect commands, made on the GPU.
struct ShadowListCommands {
  uvec4 pairs[GLOAM_PAIR_KINDS];  // of each kind: workgroups (GLOAM_PAIRS_ROW, rows, 1) and pairs that found room
  uvec4 fallback_draw;            // 6 vertices, tiles without a final list, 0, 0
};

/// What the passes count in one view, added up by the GPU. Tiles of nothing but sky are not counted.
struct ShadowListCounters {
  uint tiles;        // with a surface
  uint candidates;   // (tile, light) in early lists, directional lights included
  uint unshadowed;   // of those, lights that cast no shadow
  uint lit_at_once;  // of those, lit as a whole before any pixel is asked
  uint unlit_at_once;
  uint pairs;          // of those, whose pixels are asked; more than pair_capacity when the buffer is full
  uint lit_by_filter;  // of the pairs
  uint unlit_by_filter;
  uint slots;           // of visibility that were asked for; more than slot_capacity when the buffer is full
  uint fallback_tiles;  // tiles without a final list: shaded from shadow maps
};

GLOAM_SHARED_END

// Specialisation constants of shaders that include final_lists_api.glsl
#define GLOAM_FINAL_BITS_ID 19     // of a visibility: 8 or 4
#define GLOAM_FINAL_BUFFERS_ID 20  // visibility buffers that hold slots: 1 or 2

#endif
