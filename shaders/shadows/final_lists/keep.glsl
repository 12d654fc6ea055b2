// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_KEEP_GLSL
#define GLOAM_SHADERS_SHADOWS_KEEP_GLSL

#include "shaders/shadows/final_lists_shared.h"

// Keeps visibilities of the frame before, for list_tile_lights.glsl. Without GLOAM_SHADOWS_KEEP nothing is kept. With
// GLOAM_SHADOWS_REPROJECT they may also be reprojected.

// A run of a tile's entries in the frame before.
struct KeptRun {
  uint first;
  uint count;        // GLOAM_LIGHT_CHANGED: nothing of it can be kept
  uint next;         // where the search for the next light begins
  uint composed;     // KeptTile::composed
  uint reprojected;  // KeptTile::reprojected
};

struct LastTile {
  KeptRun suns, local;
};

LastTile no_last_tile() {
  const KeptRun none = KeptRun(0u, GLOAM_LIGHT_CHANGED, 0u, 0u, 0u);
  return LastTile(none, none);
}

#ifdef GLOAM_SHADOWS_KEEP
#include "shaders/shadows/final_lists/tile_key.glsl"
#include "shaders/shadows/kept_tiles_api.glsl"

layout(set = 0, binding = 24, scalar) readonly buffer ReservedTiles { uint reserved_tiles[]; };  // as in generate.glsl
// Of the frame before:
layout(set = 0, binding = 25, scalar) readonly buffer LastTiles { KeptTile last_tiles[]; };
layout(set = 0, binding = 26, scalar) readonly buffer LastEntries { uint last_entries[]; };
layout(set = 0, binding = 27, scalar) readonly buffer LastVisibilities0 { uint last_visibilities_0[]; };
layout(set = 0, binding = 28, scalar) readonly buffer LastVisibilities1 { uint last_visibilities_1[]; };
// Of this frame:
layout(set = 0, binding = 29, scalar) writeonly buffer KeptTiles { KeptTile kept_tiles[]; };
layout(set = 0, binding = 30, scalar) writeonly buffer Visibilities0 { uint visibilities_0[]; };
layout(set = 0, binding = 31, scalar) writeonly buffer Visibilities1 { uint visibilities_1[]; };
// The index that a light had in the frame before, or GLOAM_LIGHT_CHANGED. Local lights, and from GLOAM_MAX_LOCAL_LIGHTS
// on directional ones.
layout(set = 0, binding = 32, scalar) readonly buffer LastIndices { uint last_indices[]; };

layout(constant_id = 19) const uint kVisibilityBits = 8u;  // bits of a visibility: 8 or 4

#include "shaders/shadows/final_lists/reserved_tiles.glsl"

// Notes a tile's key for the next frame; finish.glsl adds its list.
void note_key(uint tile_index, uvec4 key) {
  kept_tiles[tile_index] = KeptTile(key, GLOAM_NO_FINAL_LIST, GLOAM_NO_FINAL_LIST, 0u, 0u, 0u, 0u);
}

KeptRun run_of(uint first, uint count, KeptTile last) {
  return KeptRun(first, count <= GLOAM_MOST_KEPT_LIGHTS ? count : GLOAM_LIGHT_CHANGED, 0u, last.composed,
                 last.reprojected);
}

// What the tile can keep. Notes its key.
LastTile last_tile(uvec2 tile, uint tile_index) {
  uvec4 key =
      tile_key(depth_image, normal_image, base_color_image, emissive_image, material_image, view.inverse_size, tile);
  note_key(tile_index, key);
  KeptTile last = last_tiles[tile_index];
  if (last.key != key || last.local_first == GLOAM_NO_FINAL_LIST) return no_last_tile();
  return LastTile(run_of(last.directional_first, last.counts >> 16, last),
                  run_of(last.local_first, last.counts & 0xFFFFu, last));
}

uint last_index_of(bool directional, uint light) {
  return last_indices[light + (directional ? uint(GLOAM_MAX_LOCAL_LIGHTS) : 0u)];
}

// The light's index in the frame before; GLOAM_LIGHT_CHANGED if its visibilities cannot be kept.
uint last_index(KeptRun run, bool directional, uint light) {
  uint last = run.count == GLOAM_LIGHT_CHANGED ? GLOAM_LIGHT_CHANGED : last_index_of(directional, light);
  if (last == GLOAM_LIGHT_CHANGED || (last & GLOAM_LIGHT_REPROJECTED) != 0u) return GLOAM_LIGHT_CHANGED;
  uint bit = kept_light_bit(directional, last & GLOAM_LAST_INDEX);
  bool recomposed = (last & GLOAM_LIGHT_RECOMPOSED) != 0u && (run.composed & bit) != 0u;
  return recomposed || (run.reprojected & bit) != 0u ? GLOAM_LIGHT_CHANGED : last & GLOAM_LAST_INDEX;
}

uint composed_lights = 0u, anew_lights = 0u, reprojected_lights = 0u;  // of the thread's tile, as in KeptTile

// Notes in which of the sets the light is. last: as last_index().
void note_light(KeptRun run, uint last, bool directional, uint light) {
  uint bit = kept_light_bit(directional, light);
  bool kept = last != GLOAM_LIGHT_CHANGED;
  if (!kept || (last_index_of(directional, light) & GLOAM_LIGHT_RECOMPOSED) != 0u) anew_lights |= bit;
  if (kept && (run.composed & kept_light_bit(directional, last)) != 0u) composed_lights |= bit;
}

// After the tile's last light.
void note_lights(uint tile_index) {
  kept_tiles[tile_index].composed = composed_lights;
  kept_tiles[tile_index].anew = anew_lights;
  kept_tiles[tile_index].reprojected = reprojected_lights;
}

// The slot that the light had, GLOAM_ALL_LIT, or GLOAM_ALL_UNLIT: lists hold no lights that are unlit as a whole.
// Mostly the lists of both frames have the same order, so the search begins after the light found last.
uint last_slot(inout KeptRun run, uint last) {
  uint found = GLOAM_ALL_UNLIT, turn = 0u, start = run.next;
  while (turn < run.count && found == GLOAM_ALL_UNLIT) {
    uint at = start + turn, entry = last_entries[run.first + at - (at < run.count ? 0u : run.count)];
    found = (entry & 1023u) == last ? entry >> 10 : found;
    ++turn;
  }
  uint at = start + turn;
  run.next = found == GLOAM_ALL_UNLIT ? start : at - (at < run.count ? 0u : run.count);
  return found;
}

void write_word(uint slot, uint i, uint word) {
  const uint words = 2u * kVisibilityBits, per_buffer = GLOAM_BUFFER_WORDS / words;
  if (slot < per_buffer)
    visibilities_0[slot * words + i] = word;
  else
    visibilities_1[(slot - per_buffer) * words + i] = word;
}

// Takes a slot for the light that had the index `last`, with its visibilities of the frame before.
uint keep_slot(inout KeptRun run, uint last, uint tile_index) {
  uint from = last_slot(run, last);
  if (from >= GLOAM_NO_ROOM) return from;
  uint to = take_free_slot_of(tile_index);
  if (to == GLOAM_NO_ROOM) return to;
  const uint words = 2u * kVisibilityBits, per_buffer = GLOAM_BUFFER_WORDS / words;
  for (uint i = 0u; i < words; ++i) {
    uint word;
    if (from < per_buffer)
      word = last_visibilities_0[from * words + i];
    else
      word = last_visibilities_1[(from - per_buffer) * words + i];
    write_word(to, i, word);
  }
  return to;
}
#else
void note_key(uint tile_index, uvec4 key) {}
LastTile last_tile(uvec2 tile, uint tile_index) { return no_last_tile(); }
uint last_index(KeptRun run, bool directional, uint light) { return GLOAM_LIGHT_CHANGED; }
void note_light(KeptRun run, uint last, bool directional, uint light) {}
void note_lights(uint tile_index) {}
uint keep_slot(inout KeptRun run, uint last, uint tile_index) { return GLOAM_NO_ROOM; }
#endif

#ifdef GLOAM_SHADOWS_REPROJECT
#include "shaders/shadows/final_lists/reproject.glsl"

const bool kReprojects = true;

bool comes(TileSource s, bool directional, uint light) {
  return may_come(s, directional, light, last_index_of(directional, light));
}

uint come_slot(TileSource s, bool directional, uint light, uint tile_index) {
  reprojected_lights |= kept_light_bit(directional, light);
  return reprojected_slot(s, directional, last_index_of(directional, light), tile_index);
}
#else
const bool kReprojects = false;
struct TileSource {
  bool found;
};
TileSource tile_source(uvec2 tile, uint tile_index, vec2 depths) { return TileSource(false); }
bool comes(TileSource s, bool directional, uint light) { return false; }
uint come_slot(TileSource s, bool directional, uint light, uint tile_index) { return GLOAM_NO_ROOM; }
#endif

#endif
