// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_EARLY_LISTS_BINDING 5
#define GLOAM_SHADOWS_BINDING 12
#define GLOAM_SHADOW_PLANES_BINDING 18
#define GLOAM_SHADOWS_PIXEL ivec2(0)
#include "shaders/lights/light_lists_api.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/final_lists/pair_places.glsl"
#include "shaders/shadows/final_lists/classify_tile.glsl"

// Makes final lists from early lists by classification. Each thread processes one tile. A light that casts no shadow,
// or that its shadow map shows to be visible from all pixels of the tile, gets an entry that is lit as a whole. A light
// that is hidden from all pixels gets no entry. Every other light becomes a tile-light pair for generate.glsl.
//
// lavapipe ends the loops of a thread after 65,535 iterations in total. Each face of a light takes at most kMostTurns
// iterations over blocks and 64 over texels.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 2, scalar) uniform Grid { FinalGrid final_grid; };
layout(set = 0, binding = 3) uniform sampler2D depth_bounds;
layout(set = 0, binding = 4) uniform usampler2D tile_lists;
layout(set = 0, binding = 6) uniform sampler2D light_texels;
layout(set = 0, binding = 7, rgba32ui) uniform writeonly uimage2D final_tiles;
layout(set = 0, binding = 8, scalar) writeonly buffer Entries { uint entries[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer Pairs { uint pairs[]; };
layout(set = 0, binding = 10, scalar) buffer Counters { ShadowListCounters counters; };
layout(set = 0, binding = 11, scalar) buffer Commands { ShadowListCommands commands; };
layout(set = 0, binding = 19) uniform sampler2D depth_image;
layout(set = 0, binding = 20) uniform usampler2D normal_image;
layout(set = 0, binding = 21) uniform sampler2D base_color_image;

int local_kind(uint light) { return int(texelFetch(shadow_rows, ivec2(0, light), 0).x); }

bool casts(bool directional, uint light) {
  return directional ? fetch_sun(light).x > 0.0 : local_kind(light) != GLOAM_SHADOW_NONE;
}

uint classify_group(TileBounds t, bool directional, uint light, int most_turns, inout bool in_face) {
  if (directional)
    return classify_directional(t, light, texelFetch(shadow_rows, ivec2(6, cascade_row(light, 0u)), 0).xyz, most_turns);
  bool here;
  uint verdict = classify_local(t, light, texelFetch(light_texels, ivec2(0, light), 0).xyz, most_turns, here);
  in_face = in_face && (here || verdict == kNotAsked);
  return verdict;
}

// The verdict on which the groups of the tile's pixels agree. in_face: all taps of the pixels are in one face.
uint classify(TileGroups tile, bool directional, uint light, int most_turns, out bool in_face) {
  uint verdict = kNotAsked;
  in_face = !directional;
  int group = 0;
  do {
    TileBounds t = tile.one;
    if (group == 1) t = tile.two;
    uint here = classify_group(t, directional, light, most_turns, in_face);
    verdict = verdict == kNotAsked || verdict == here ? here : here == kNotAsked ? verdict : kUnknown;
  } while (++group < (tile.has_two ? 2 : 1));
  return verdict == kNotAsked ? kUnlit : verdict;
}

// Most blocks of planes that are tested per face of a light. If the tile has more than kMostFaces faces of lights, none
// are tested, and classification finds no light lit.
const int kMostTurns = 160;
const uint kMostFaces = 128u;

// Counts of this thread.
uint unshadowed, lit_at_once, unlit_at_once;

// Makes a tile-light pair of an entry. Returns the slot that the entry holds until the pair is filtered: the tile's
// index, or GLOAM_NO_ROOM when the buffer of pairs is full.
uint add_pair(uint entry, uint tile_index, uint kind) {
  if (atomicAdd(counters.pairs, 1u) >= final_grid.pair_capacity) return GLOAM_NO_ROOM;
  uint pair = atomicAdd(commands.pairs[kind].w, 1u);
  pairs[pair_place(final_grid, kind, pair)] = entry;
  if (pair % GLOAM_PAIRS_ROW == 0u) atomicMax(commands.pairs[kind].y, pair / GLOAM_PAIRS_ROW + 1u);
  return tile_index;
}

// Classifies the light and writes its entry at index `entry`, which is then incremented, unless the light is unlit.
void add_light(TileGroups tile, uint tile_index, bool directional, uint light, int most_turns, inout uint entry) {
  bool in_face = directional || local_kind(light) == GLOAM_SHADOW_SPOT;
  uint verdict = final_grid.classify != 0u   ? classify(tile, directional, light, most_turns, in_face)
                 : casts(directional, light) ? kUnknown
                                             : kCastsNone;
  unshadowed += uint(verdict == kCastsNone);
  lit_at_once += uint(verdict == kLit);
  unlit_at_once += uint(verdict == kUnlit);
  if (verdict == kUnlit) return;
  uint slot = GLOAM_ALL_LIT;
  if (verdict == kUnknown)
    slot = add_pair(entry, tile_index,
                    directional ? uint(GLOAM_PAIRS_DIRECTIONAL)
                    : in_face   ? uint(GLOAM_PAIRS_IN_FACE)
                                : uint(GLOAM_PAIRS_CROSSING));
  entries[entry++] = light | slot << 10;
}

void count_tile(uint candidates) {
  atomicAdd(counters.tiles, 1u);
  if (candidates != 0u) atomicAdd(counters.candidates, candidates);
  if (unshadowed != 0u) atomicAdd(counters.unshadowed, unshadowed);
  if (lit_at_once != 0u) atomicAdd(counters.lit_at_once, lit_at_once);
  if (unlit_at_once != 0u) atomicAdd(counters.unlit_at_once, unlit_at_once);
}

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(at, final_grid.tiles))) return;
  vec2 bounds = texelFetch(depth_bounds, ivec2(at), 0).xy;
  if (bounds.y <= 0.0) {
    imageStore(final_tiles, ivec2(at), uvec4(0u));
    return;
  }
  uvec2 list = final_grid.has_early_lists != 0u ? texelFetch(tile_lists, ivec2(at), 0).xy : uvec2(0u);
  uint tile_index = at.y * final_grid.tiles.x + at.x;
  uint count = list_count(list),
       shared_entries = final_grid.tiles.x * final_grid.tiles.y * final_grid.directional_count;
  // Two comparisons, because the sum could overflow.
  if (!has_list(list) || shared_entries > final_grid.entry_capacity ||
      list.x > final_grid.entry_capacity - shared_entries ||
      count > final_grid.entry_capacity - shared_entries - list.x) {
    imageStore(final_tiles, ivec2(at), uvec4(GLOAM_NO_FINAL_LIST, GLOAM_NO_FINAL_LIST, 0u, 0u));
    return;
  }
  unshadowed = lit_at_once = unlit_at_once = 0u;
  TileGroups tile = make_tile_groups(view, depth_image, normal_image, base_color_image, at);
  int most_turns = count + final_grid.directional_count * uint(GLOAM_MAX_CASCADES) <= kMostFaces ? kMostTurns : 0;
  uvec2 first = uvec2(tile_index * final_grid.directional_count, shared_entries + list.x), end = first;
  for (uint i = 0u; i < final_grid.directional_count; ++i) add_light(tile, tile_index, true, i, most_turns, end.x);
  for (uint i = 0u; i < count; ++i) add_light(tile, tile_index, false, list_light(list.x, i), most_turns, end.y);
  imageStore(final_tiles, ivec2(at), uvec4(first, (end.x - first.x) << 16 | (end.y - first.y), 0u));
  count_tile(final_grid.directional_count + count);
}
