// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_FINAL_LISTS_SHARED_H
#define GLOAM_SHADERS_SHADOWS_FINAL_LISTS_SHARED_H

#include "shaders/common/prelude.h"

// Final lists (shadows.mode=deferred): which lights reach each shadow tile, and how much of each light its pixels see.
//
// A tile's entries are two runs of the buffer of entries: one of directional lights and one of local lights, each in
// ascending order of lights. An entry is 10 bits of light (index among the view's directional or local lights) and 22
// bits of slot: the number of a visibility slot, GLOAM_ALL_LIT (every pixel sees the whole light; also for lights
// without shadows), or GLOAM_ALL_UNLIT (no pixel sees any of it; never in finished lists). A visibility slot is 64
// visibilities, row by row, of 8 or 4 bits: 32-bit words of four or eight, the first pixel in the lowest bits.
//
// Each tile has one texel (rgba32ui). x: its first directional entry, y: its first local entry; both are
// GLOAM_NO_FINAL_LIST for a fallback tile, which is shaded from its early list, or its group mask, and from shadow
// maps. z: number of local entries (low 16 bits) and of directional entries (high 16 bits); both 0 for a fallback tile.
// w: 0.

#define GLOAM_ALL_LIT 0x3FFFFEu
#define GLOAM_ALL_UNLIT 0x3FFFFFu
#define GLOAM_NO_ROOM 0x3FFFFDu  // only in unfinished lists: no slot or no pair was free for the entry
#define GLOAM_NO_FINAL_LIST 0xFFFFFFFFu
#define GLOAM_SLOT_PIXELS 64
#define GLOAM_VISIBILITY_BUFFERS 2    // slots fill the first, then the second
#define GLOAM_BUFFER_WORDS 33554432u  // most words of one of them: 128 MiB
// Kinds of tile-light pairs, each with its own shader. All are in one buffer: in-face pairs from index 0 up, crossing
// pairs from pair_capacity − 1 down, directional pairs from pair_capacity up (at most one per tile and directional
// light of the view).
#define GLOAM_PAIRS_IN_FACE 0   // local lights; all taps of the tile's pixels are in one face, no blocker is near
#define GLOAM_PAIRS_CROSSING 1  // other local lights; taps may be in several faces of a cube, blockers may be near
#define GLOAM_PAIRS_DIRECTIONAL 2
#define GLOAM_PAIR_KINDS 3
#define GLOAM_PAIRS_ROW 256  // workgroups in a row of the dispatch over pairs
// Kinds of candidates: tile lights whose light casts a shadow, before classification. Local and directional ones, of
// tiles with one and with two groups of pixels.
#define GLOAM_CANDIDATES_LOCAL 0
#define GLOAM_CANDIDATES_DIRECTIONAL 2
#define GLOAM_CANDIDATES_TWO_GROUPS 1  // is added
#define GLOAM_CANDIDATE_KINDS 4
#define GLOAM_CANDIDATE_GROUP 64               // candidates of a workgroup
#define GLOAM_LIGHT_CHANGED 0xFFFFFFFFu        // in place of a light's index in the frame before
#define GLOAM_LIGHT_RECOMPOSED 0x80000000u     // added to that index: later modules change its visibilities otherwise
#define GLOAM_LIGHT_REPROJECTED 0x40000000u    // the same: its visibilities cannot be kept, but reprojected
#define GLOAM_LIGHT_CASTERS_MOVED 0x20000000u  // the same: where no caster that has moved is in its way
#define GLOAM_LAST_INDEX 0x1FFFFFFFu           // the index without these flags
#define GLOAM_MOST_KEPT_LIGHTS 128u            // of a kind; tiles with more keep none
#define GLOAM_DIM_LIGHT 0x80000000u            // flag of an entry's index in candidates and pairs: the light is dim
#define GLOAM_PARTLY_REACHED 0x40000000u       // flag in pairs: the light may not illuminate all pixels of the tile
#define GLOAM_ENTRY_FLAGS 0xC0000000u
#define GLOAM_DIM_LIGHTS 4.0  // most light that dim lights may add to a tile, over FinalGrid::dim_light
#define GLOAM_DIM_PIXELS 8    // pixels of a tile that are asked about a dim light, one in each row

GLOAM_SHARED_BEGIN

/// Layout and capacities of the view's final lists.
struct FinalGrid {
  uvec2 tiles;             // shadow tiles
  uint directional_count;  // directional lights; the first tiles.x · tiles.y · directional_count entries are theirs
  uint has_early_lists;    // 0: the view has no local lights
  uint entry_capacity;
  uint candidate_capacity;  // of local candidates, and again of directional ones
  uint pair_capacity;
  uint slot_capacity;
  uint classify;        // 0: no classification; every casting light is evaluated at every pixel
  uint reserved_slots;  // the first slots, which only reserved tiles take (slots_api.glsl); 0: no tile is reserved
  float dim_light;      // radiance · light_scale below which a light is dim (dim_lights.glsl); 0: none is
};

/// What a shadow tile leaves for the next frame, if that reuses visibilities. Firsts and counts are those of its final
/// list before later passes add to it, in the entries of the frame that wrote them.
struct KeptTile {
  uvec4 key;               // tile_key() of its pixels; 0: it shows only sky
  uint directional_first;  // GLOAM_NO_FINAL_LIST: the tile has nothing to reuse
  uint local_first;
  uint counts;  // as z of the tile's texel
  // Sets of lights (kept_tiles_api.glsl). composed: later modules have changed their visibilities. anew: later modules
  // have still to look at them in this frame.
  uint composed;
  uint anew;
  uint reprojected;  // their visibilities are not exact: they were reprojected (reproject.glsl)
};

/// Arguments of indirect commands, written by the GPU.
struct ShadowListCommands {
  uvec4 pairs[GLOAM_PAIR_KINDS];  // by kind: workgroups (GLOAM_PAIRS_ROW, rows, 1) and the number of pairs
  uvec4 fallback_draw;            // 6 vertices, one instance per fallback tile, 0, 0
};

/// The same for the dispatches over candidates.
struct ShadowCandidateCommands {
  uvec4 candidates[GLOAM_CANDIDATE_KINDS];  // by kind: workgroups (count, 1, 1) and the number of candidates
  uvec4 asked;                              // local and directional candidates asked for, 0, 0
};

/// Bounds of a group of pixels of a shadow tile (tile_bounds.glsl), as stored for classification. A pixel that is
/// judged on its smooth surface (pixel_receiver()) is in the bounds with both positions; its face normal is the smooth
/// surface's.
struct ShadowTileGroup {
  vec3 normal;           // face normal of a few of the pixels, unit
  float spread;          // greatest length of the difference between `normal` and a pixel's face normal
  float shading_spread;  // the same for shading normals
  vec2 offsets;          // least and greatest dot(normal, position) of the pixels
  vec2 depths;           // least and greatest depth of the pixels (reversed Z)
  uint pixels;  // 3 bits each: least x and y of the pixels in the tile, greatest x and y; then GLOAM_GROUP_…;
                // high half: at least the distance to any smooth surface, half precision, 0: none is smooth
};
#define GLOAM_GROUP_SUBSURFACE 0x1000u  // any pixel has a subsurface material
#define GLOAM_GROUP_TRANSMITS 0x2000u   // light from behind reaches any pixel

/// Counters of one view, summed by the GPU. Tiles that show only sky are not counted.
struct ShadowListCounters {
  uint tiles;            // tiles with a surface
  uint candidates;       // tile lights: entries of early lists, and each directional light once per tile
  uint unshadowed;       // tile lights of lights that cast no shadow
  uint lit_at_once;      // tile lights classified as lit
  uint unlit_at_once;    // tile lights classified as unlit
  uint pairs;            // tile-light pairs, whose pixels are filtered; above pair_capacity when the buffer is full
  uint lit_by_filter;    // pairs that the filter finds lit in all pixels
  uint unlit_by_filter;  // pairs that the filter finds unlit in all pixels
  uint slots;            // visibility slots needed; above slot_capacity when the buffer is full
  uint fallback_tiles;   // fallback tiles
  uint reserved_slots;   // of `slots`: those of reserved tiles, in frames with reserved slots
  uint other_slots;      // of `slots`: those of other tiles, in frames with reserved slots
  uint kept;             // tile lights whose visibilities are those of the frame before
  uint reprojected;      // tile lights whose visibilities are reprojected from the frame before
  uint dim;              // pairs of dim lights (of `pairs`)
  uint dim_light;  // the greatest sum of a tile's bounds of dim lights over FinalGrid::dim_light, as a float's bits
};

GLOAM_SHARED_END

#endif
