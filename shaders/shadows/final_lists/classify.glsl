// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_CLASSIFY_GLSL
#define GLOAM_SHADERS_SHADOWS_CLASSIFY_GLSL

// Classifies candidates: tile lights whose light casts a shadow. A light that its shadow map shows to be visible from
// all pixels of the tile gets an entry that is lit as a whole, and one that is hidden from all pixels an entry that is
// unlit. Every other light becomes a tile-light pair for generate.glsl. Each thread processes one candidate.
//
// Before including this, define GLOAM_CLASSIFY_SUNS for directional lights.

#define GLOAM_SHADOWS_BINDING 13
#define GLOAM_SHADOW_PLANES_BINDING 11
#define GLOAM_SHADOWS_PIXEL ivec2(0)
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/final_lists/classify_tile.glsl"

layout(local_size_x = GLOAM_CANDIDATE_GROUP) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 2, scalar) uniform Grid { FinalGrid final_grid; };
layout(set = 0, binding = 3) uniform sampler2D light_texels;
layout(set = 0, binding = 4, scalar) buffer Entries { uint entries[]; };
layout(set = 0, binding = 5, scalar) writeonly buffer Pairs { uint pairs[]; };
layout(set = 0, binding = 6, scalar) buffer Counters { ShadowListCounters counters; };
layout(set = 0, binding = 7, scalar) buffer Commands { ShadowListCommands commands; };
layout(set = 0, binding = 8, scalar) readonly buffer Candidates { uint candidates[]; };
layout(set = 0, binding = 9, scalar) readonly buffer TileGroupsIn { ShadowTileGroup tile_groups[]; };
layout(set = 0, binding = 10, scalar) readonly buffer CandidateCommands { ShadowCandidateCommands candidate_commands; };
layout(push_constant, scalar) uniform Constants { uint candidate_kind; };

#include "shaders/shadows/final_lists/take_pair.glsl"

const int kMostTurns = 160;  // most blocks of planes that are tested per face of a light

// in_face: set to false unless classify_local() sets it. partly: set if the light may not illuminate all pixels.
uint classify_group(uint light, uint tile_index, uint group, inout bool in_face, inout bool partly) {
  TileBounds t = tile_bounds(view, uvec2(tile_index % final_grid.tiles.x, tile_index / final_grid.tiles.x),
                             tile_groups[2u * tile_index + group]);
#ifdef GLOAM_CLASSIFY_SUNS
  vec3 direction = texelFetch(shadow_rows, ivec2(6, cascade_row(light, 0u)), 0).xyz;
  partly = partly || dot(t.normal, direction) > -t.shading_spread;
  return classify_directional(t, light, direction, kMostTurns);
#else
  bool here;
  vec4 place = texelFetch(light_texels, ivec2(0, light), 0);  // position, inverse_range_squared
  float farthest = distance(t.center, place.xyz) + t.radius;
  partly = partly || farthest * farthest * place.w > 1.0 || !is_faced(t, place.xyz);
  uint verdict = classify_local(t, light, place.xyz, kMostTurns, here);
  in_face = in_face && (here || verdict == kNotAsked);
  return verdict;
#endif
}

// The verdict on which the groups of the tile's pixels agree. in_face, partly: see classify_group().
uint classify(uint light, uint tile_index, out bool in_face, out bool partly) {
  uint groups = (candidate_kind & uint(GLOAM_CANDIDATES_TWO_GROUPS)) + 1u, verdict = kNotAsked, group = 0u;
  in_face = true;
  partly = false;
  do {
    verdict = agreed(verdict, classify_group(light, tile_index, group, in_face, partly));
  } while (++group < groups);
  return verdict == kNotAsked ? kUnlit : verdict;
}

void main() {
  uint number = gl_GlobalInvocationID.x;
  if (number >= candidate_commands.candidates[candidate_kind].w) return;
  uint candidate = candidates[candidate_place(final_grid, candidate_kind, number)];
  uint at = candidate & ~GLOAM_DIM_LIGHT, entry = entries[at], light = entry & 1023u, tile_index = entry >> 10,
       verdict = kUnknown;
  bool in_face = false, partly = false;
  if (final_grid.classify != 0u) verdict = classify(light, tile_index, in_face, partly);
#ifdef GLOAM_CLASSIFY_SUNS
  uint kind = uint(GLOAM_PAIRS_DIRECTIONAL);
#else
  uint kind = uint(in_face ? GLOAM_PAIRS_IN_FACE : GLOAM_PAIRS_CROSSING);
#endif
  uint slot = verdict == kLit ? GLOAM_ALL_LIT : GLOAM_ALL_UNLIT;
  if (verdict == kLit) atomicAdd(counters.lit_at_once, 1u);
  if (verdict == kUnlit) atomicAdd(counters.unlit_at_once, 1u);
  if (verdict == kUnknown) slot = take_pair(candidate | (partly ? GLOAM_PARTLY_REACHED : 0u), tile_index, kind);
  entries[at] = light | slot << 10;
}

#endif
