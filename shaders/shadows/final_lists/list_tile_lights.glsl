// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_LIST_TILE_LIGHTS_GLSL
#define GLOAM_SHADERS_SHADOWS_LIST_TILE_LIGHTS_GLSL

#define GLOAM_EARLY_LISTS_BINDING 5
#define GLOAM_SHADOWS_BINDING 13
#define GLOAM_SHADOWS_PIXEL ivec2(0)
#define GLOAM_SMOOTH_SURFACE_BINDING 22
#include "shaders/lights/light_lists_api.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/shadows_api.glsl"
#include "shaders/shadows/final_lists/dim_lights.glsl"
#include "shaders/shadows/final_lists/tile_groups.glsl"

// Starts final lists from early lists. Each thread processes one tile. A light that casts no shadow gets an entry that
// is lit as a whole. Every other light becomes a candidate for classify.glsl, and the tile's pixels are grouped for it.
//
// With GLOAM_SHADOWS_KEEP, a light that has not changed since the last frame, in a tile that has not either, keeps its
// visibilities (shadows.reuse) and is no candidate. With GLOAM_SHADOWS_REPROJECT a light may take them from where the
// tile's surfaces were seen in the last frame (reproject.glsl).

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 2, scalar) uniform Grid { FinalGrid final_grid; };
layout(set = 0, binding = 3) uniform sampler2D depth_bounds;
layout(set = 0, binding = 4) uniform usampler2D tile_lists;
layout(set = 0, binding = 6, rgba32ui) uniform writeonly uimage2D final_tiles;
layout(set = 0, binding = 7, scalar) writeonly buffer Entries { uint entries[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer Pairs { uint pairs[]; };
layout(set = 0, binding = 9, scalar) buffer Counters { ShadowListCounters counters; };
layout(set = 0, binding = 10, scalar) buffer Commands { ShadowListCommands commands; };
layout(set = 0, binding = 11, scalar) writeonly buffer Candidates { uint candidates[]; };
layout(set = 0, binding = 12, scalar) writeonly buffer TileGroupsOut { ShadowTileGroup tile_groups[]; };
layout(set = 0, binding = 1, scalar) buffer CandidateCommands { ShadowCandidateCommands candidate_commands; };
layout(set = 0, binding = 19) uniform sampler2D depth_image;
layout(set = 0, binding = 20) uniform usampler2D normal_image;
layout(set = 0, binding = 21) uniform sampler2D base_color_image;
layout(set = 0, binding = 23) uniform sampler2D emissive_image;
layout(set = 0, binding = 33) uniform sampler2D light_texels;
layout(set = 0, binding = 34) uniform sampler2D material_image;

#include "shaders/shadows/final_lists/keep.glsl"
#include "shaders/shadows/final_lists/take_pair.glsl"

int local_kind(uint light) { return int(texelFetch(shadow_rows, ivec2(0, light), 0).x); }

bool casts(bool directional, uint light) {
  return directional ? fetch_sun(light).x > 0.0 : local_kind(light) != GLOAM_SHADOW_NONE;
}

// Adds the light of an entry to the candidates. If they are full, its pixels are filtered without classification.
// dim: GLOAM_DIM_LIGHT or 0. Returns the slot that the entry holds until then.
uint add_candidate(uint entry, uint tile_index, bool directional, uint light, bool two_groups, uint dim) {
  uint asked = directional ? atomicAdd(candidate_commands.asked.y, 1u) : atomicAdd(candidate_commands.asked.x, 1u);
  if (asked >= final_grid.candidate_capacity)
    return take_pair(entry | dim, tile_index, uint(directional ? GLOAM_PAIRS_DIRECTIONAL : GLOAM_PAIRS_CROSSING));
  uint kind = uint(directional ? GLOAM_CANDIDATES_DIRECTIONAL : GLOAM_CANDIDATES_LOCAL) |
              (two_groups ? uint(GLOAM_CANDIDATES_TWO_GROUPS) : 0u);
  uint candidate = atomicAdd(candidate_commands.candidates[kind].w, 1u);
  candidates[candidate_place(final_grid, kind, candidate)] = entry | dim;
  if (candidate % GLOAM_CANDIDATE_GROUP == 0u) atomicAdd(candidate_commands.candidates[kind].x, 1u);
  return tile_index;
}

uint unshadowed;  // tile lights of this thread whose light casts no shadow
uint kept;        // those that keep their visibilities
uint came;        // and those whose visibilities are reprojected

// Lights of the tile whose visibilities are reprojected: a bit each, directional ones first, then local ones in the
// order of the list.
uint coming[5];
const uint kMostComing = 160u;

bool is_coming(uint order) {
  return kReprojects && order < kMostComing && (coming[min(order >> 5, 4u)] >> (order & 31u) & 1u) != 0u;
}

// order: as for `coming`.
void add_light(uint entry, uint tile_index, bool directional, uint light, uint order, TileSource source,
               bool two_groups, uint dim, inout KeptRun run) {
  uint slot = GLOAM_ALL_LIT, last = last_index(run, directional, light);
  note_light(run, last, directional, light);
  if (!casts(directional, light)) {
    ++unshadowed;
  } else if (last != GLOAM_LIGHT_CHANGED) {
    slot = keep_slot(run, last, tile_index);
    ++kept;
  } else if (is_coming(order)) {
    slot = come_slot(source, directional, light, tile_index);
    ++came;
  } else {
    slot = add_candidate(entry, tile_index, directional, light, two_groups, dim);
  }
  entries[entry] = light | slot << 10;
}

// What decides which lights of a tile are dim.
struct DimLights {
  TileBounds one, two;  // of its groups of pixels
  bool has_two;
  TileMaterials materials;
  float left;  // what further dim lights may add
};

DimLights dim_lights(TileGroups g, uvec2 tile) {
  DimLights d;
  d.one = tile_bounds(view, tile, g.one);
  d.has_two = g.has_two;
  if (g.has_two) d.two = tile_bounds(view, tile, g.two);
  d.materials = tile_materials(base_color_image, material_image, view.inverse_size, tile);
  d.left = GLOAM_DIM_LIGHTS * final_grid.dim_light;
  return d;
}

// GLOAM_DIM_LIGHT if the local light is dim in the tile, else 0.
uint dim_flag(inout DimLights d, uint light) {
  LocalLight l = fetch_light(light_texels, light);
  float emitter_m = 0.5 * max(texelFetch(shadow_rows, ivec2(0, light), 0).z, 0.0);
  float most = most_light(view, d.one, d.materials, l, emitter_m);
  if (d.has_two) most = max(most, most_light(view, d.two, d.materials, l, emitter_m));
  bool dim = casts(false, light) && most <= min(final_grid.dim_light, d.left);
  d.left -= dim ? most : 0.0;
  return dim ? GLOAM_DIM_LIGHT : 0u;
}

// Whether the light is to be classified. Notes whether it is coming.
bool is_new(KeptRun run, TileSource source, bool directional, uint light, uint order) {
  if (last_index(run, directional, light) != GLOAM_LIGHT_CHANGED || !casts(directional, light)) return false;
  bool comes_from = order < kMostComing && comes(source, directional, light);
  if (comes_from) coming[order >> 5] |= 1u << (order & 31u);
  return !comes_from;
}

// Whether a light of the tile is to be classified. Sets `coming`.
bool has_new_light(LastTile last, TileSource source, uint suns, uint first, uint count) {
  coming = uint[](0u, 0u, 0u, 0u, 0u);
  bool found = false;  // one light decides, unless each has its bit to be set
  for (uint i = 0u; i < suns; ++i) found = (found && !kReprojects) || is_new(last.suns, source, true, i, i) || found;
  for (uint i = 0u; i < count; ++i)
    found = (found && !kReprojects) || is_new(last.local, source, false, list_light(first, i), suns + i) || found;
  return found;
}

void main() {
  uvec2 at = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(at, final_grid.tiles))) return;
  vec2 bounds = texelFetch(depth_bounds, ivec2(at), 0).xy;
  uint tile_index = at.y * final_grid.tiles.x + at.x;
  if (bounds.y <= 0.0) {
    imageStore(final_tiles, ivec2(at), uvec4(0u));
    note_key(tile_index, uvec4(0u));
    return;
  }
  TileSource source = tile_source(at, tile_index, bounds);
  uvec2 list = final_grid.has_early_lists != 0u ? texelFetch(tile_lists, ivec2(at), 0).xy : uvec2(0u);
  uint suns = final_grid.directional_count, count = list_count(list),
       shared_entries = final_grid.tiles.x * final_grid.tiles.y * suns;
  // Two comparisons, because the sum could overflow.
  if (!has_list(list) || shared_entries > final_grid.entry_capacity ||
      list.x > final_grid.entry_capacity - shared_entries ||
      count > final_grid.entry_capacity - shared_entries - list.x) {
    imageStore(final_tiles, ivec2(at), uvec4(GLOAM_NO_FINAL_LIST, GLOAM_NO_FINAL_LIST, 0u, 0u));
    return;
  }
  LastTile last = last_tile(at, tile_index);
  bool two_groups = false, asks_dim = false;
  DimLights dim;
  bool has_new = has_new_light(last, source, suns, list.x, count);
  if (final_grid.classify != 0u && has_new) {
    TileGroups groups = make_tile_groups(view, depth_image, normal_image, base_color_image, emissive_image, at);
    two_groups = groups.has_two;
    tile_groups[2u * tile_index] = groups.one;
    if (two_groups) tile_groups[2u * tile_index + 1u] = groups.two;
    asks_dim = kDimLights != 0u;
    if (asks_dim) dim = dim_lights(groups, at);
  }
  unshadowed = kept = came = 0u;
  uvec2 first = uvec2(tile_index * suns, shared_entries + list.x);
  for (uint i = 0u; i < suns; ++i) add_light(first.x + i, tile_index, true, i, i, source, two_groups, 0u, last.suns);
  for (uint i = 0u; i < count; ++i) {
    uint light = list_light(list.x, i), flag = 0u;
    if (asks_dim) flag = dim_flag(dim, light);
    add_light(first.y + i, tile_index, false, light, suns + i, source, two_groups, flag, last.local);
  }
  if (asks_dim) atomicMax(counters.dim_light, floatBitsToUint(GLOAM_DIM_LIGHTS - dim.left / final_grid.dim_light));
  note_lights(tile_index);
  imageStore(final_tiles, ivec2(at), uvec4(first, suns << 16 | count, 0u));
  atomicAdd(counters.tiles, 1u);
  if (suns + count != 0u) atomicAdd(counters.candidates, suns + count);
  if (unshadowed != 0u) atomicAdd(counters.unshadowed, unshadowed);
  if (kept != 0u) atomicAdd(counters.kept, kept);
  if (came != 0u) atomicAdd(counters.reprojected, came);
}

#endif
