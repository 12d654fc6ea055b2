// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_CLOSEUPS_TILES_GLSL
#define GLOAM_SHADERS_CLOSEUPS_TILES_GLSL

// Before including this, define GLOAM_SHADOWS_KINDS: 1 for local lights, 4 for directional ones.
//
// Lists the tiles of a pair's umbra range that compose.glsl must look at: those that list the light, do not show what
// was composed in the last frame, and are not certainly aside of the subject's shadow. One thread per tile.

#define GLOAM_SHADOWS_BINDING 12
#define GLOAM_SHADOWS_PIXEL ivec2(0)  // unused: no visibility is evaluated
#include "shaders/closeups/closeups_shared.h"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/kept_tiles_api.glsl"
#include "shaders/shadows/shadows_api.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Closeup { CloseupConstants closeup; };
layout(set = 0, binding = 2, scalar) uniform Grid { FinalGrid final_grid; };
layout(set = 0, binding = 3) uniform sampler2D depth_bounds;
layout(set = 0, binding = 6) uniform sampler2D light_texels;
layout(set = 0, binding = 7) uniform usampler2D final_tiles;
layout(set = 0, binding = 8, scalar) readonly buffer Entries { uint entries[]; };
layout(set = 0, binding = 9, scalar) readonly buffer KeptTiles { KeptTile kept_tiles[]; };
layout(set = 0, binding = 10, scalar) buffer PairCommands { uvec4 pair_commands[]; };
layout(set = 0, binding = 11, scalar) writeonly buffer PairTiles { uvec2 pair_tiles[]; };

layout(push_constant, scalar) uniform Push { uint has_anew; };  // 1: KeptTile::anew is set

#if GLOAM_SHADOWS_KINDS == 4
// Homogeneous position in the face: x and y in texels, z is the depth; w is 1.
vec4 place_in_face(vec3 light_position, vec3 position) {
  vec4 p = vec4(position, 1.0);
  return vec4(dot(closeup.row_u, p), dot(closeup.row_v, p), dot(closeup.row_depth, p), 1.0);
}

float penumbra_texels() { return closeup.penumbra_m_per_m * closeup.depth_m / closeup.texel_m; }
#else
// Homogeneous position in the face: x and y in texels, z is the depth, all times w. w: metres in front of the light,
// must be > 0.
vec4 place_in_face(vec3 light_position, vec3 position) {
  vec3 v = position - light_position;
  float z = dot(v, cross(closeup.up, closeup.right)), texels = 0.5 * closeup.size / closeup.tan_half;
  return vec4(dot(v, closeup.right) * texels + 0.5 * closeup.size * z,
              -dot(v, closeup.up) * texels + 0.5 * closeup.size * z, closeup.near_m, z);
}

// Width of a penumbra in texels, per unit of depth between blocker and receiver.
float penumbra_texels() {
  return closeup.emitter_diameter_m * closeup.size / (closeup.near_m * 2.0 * closeup.tan_half);
}
#endif

float reach_of(float penumbra) { return 2.0 * penumbra + 14.0; }

// The nearest depth of texels [low, high] of the face: as nearest_in_face(), but from pyramid texels of about a quarter
// of the size, and without those beside the rectangle.
float nearest_between(vec2 low, vec2 high) {
  low = clamp(low, vec2(0.0), vec2(closeup.size)) * 0.25;
  high = clamp(high, vec2(0.0), vec2(closeup.size)) * 0.25;
  int last = floor_log2(closeup.size) - GLOAM_SHADOW_PYRAMID_MIP - 1;
  // Eight by eight texels hold a square seven texels wide at any position.
  int level = clamp(ceil_log2(max(max(high.x - low.x, high.y - low.y) / 7.0, 1.0)), 0, last);
  MipSquare square = mip_square(closeup.origin * 0.25, closeup.size * 0.25, level, shadow_block.atlas_size * 0.25);
  low /= square.texel;
  high /= square.texel;
  vec2 first = floor(low) + 1.0;
  float nearest = 0.0;
  for (int i = 0; i < 16; ++i) {
    vec2 corner = clamp(first + 2.0 * vec2(i & 3, i >> 2), vec2(1.0), vec2(square.size - 1.0));
    vec4 depth = textureGather(shadow_pyramid, (square.corner + corner) * shadow_texel_size() * vec2(4.0, 2.0));
    // Columns and rows [corner - 1, corner] and [corner, corner + 1].
    bvec2 before = lessThanEqual(low, corner), after = greaterThanEqual(high, corner);
    bvec2 reaches_before = greaterThanEqual(high, corner - 1.0), reaches_after = lessThanEqual(low, corner + 1.0);
    bvec2 one = bvec2(before.x && reaches_before.x, before.y && reaches_before.y);
    bvec2 two = bvec2(after.x && reaches_after.x, after.y && reaches_after.y);
    depth = mix(vec4(0.0), depth, bvec4(one.x && two.y, two.x && two.y, two.x && one.y, one.x && one.y));
    nearest = max(nearest, nearest_of(depth));
  }
  return nearest;
}

// Whether the subject certainly hides no light from any pixel of the tile: the tile is outside the face, or no depth in
// the face is near enough to the paths between the tile and the emitter.
bool subject_is_aside(vec3 light_position, uvec2 tile) {
  vec2 bounds = texelFetch(depth_bounds, ivec2(tile), 0).xy;
  if (bounds.y <= 0.0) return true;
  vec2 begin = vec2(tile * uint(GLOAM_SHADOW_TILE)) - 0.5,
       end = min(begin + float(GLOAM_SHADOW_TILE), vec2(view.size) - 0.5);
  vec2 low = vec2(1e30), high = vec2(-1e30);
  bvec4 outside = bvec4(true);
  float farthest = 1e30, least_w = 1e30, most_w = 0.0;
  for (int i = 0; i < 8; ++i) {
    vec2 pixel = vec2((i & 1) != 0 ? end.x : begin.x, (i & 2) != 0 ? end.y : begin.y);
    vec4 at = place_in_face(light_position, relative_position(view, pixel, i < 4 ? bounds.x : bounds.y));
    outside.xy = bvec2(outside.x && at.x < 0.0, outside.y && at.y < 0.0);
    outside.zw = bvec2(outside.z && at.x > closeup.size * at.w, outside.w && at.y > closeup.size * at.w);
    least_w = min(least_w, at.w);
    most_w = max(most_w, at.w);
    vec3 place = at.xyz / max(at.w, 1e-30);
    low = min(low, place.xy);
    high = max(high, place.xy);
    farthest = min(farthest, place.z);
  }
  if (any(outside) || most_w < closeup.near_m) return true;
  if (least_w <= 0.02 * most_w) return false;  // too near to the light's plane for useful bounds
  // Two steps: the nearest depth in a wide search region gives a smaller region.
  float nearest = 1.0, widest, unused;
  for (int step = 0; step < 2; ++step) {
    widest = clamp(penumbra_texels() * (nearest - farthest), 0.0, closeup.size);
    // Wider than the reach of any kernel of a penumbra this wide.
    nearest = nearest_in_face(closeup.origin, closeup.size, low - reach_of(widest), high + reach_of(widest), unused);
  }
  if (nearest <= 0.999 * farthest) return true;
  // A finer look at the texels that matter. Single fetches lie within half of the widest search region.
  float reach = reach_of(clamp(penumbra_texels() * (nearest - farthest), 0.0, closeup.size));
  if (kFilter == 2u) reach = min(reach, 0.5 * max(widest, float(kKernel)) + 10.0);
  return nearest_between(low - reach, high + reach) <= 0.999 * farthest;
}

// The place of the light's entry in `entries`; GLOAM_NO_FINAL_LIST if the tile does not list it, or all of it is unlit.
uint place_of_light(uvec2 tile) {
  uvec3 list = texelFetch(final_tiles, ivec2(tile), 0).xyz;
  bool directional = GLOAM_SHADOWS_KINDS == 4;
  uint found = GLOAM_NO_FINAL_LIST, slot = GLOAM_ALL_UNLIT, first = directional ? list.x : list.y;
  uint count = list.y == GLOAM_NO_FINAL_LIST ? 0u : directional ? list.z >> 16 : list.z & 0xFFFFu;
  if (has_anew != 0u && count != 0u) {
    uint anew = kept_tiles[tile.y * final_grid.tiles.x + tile.x].anew;
    count = (anew & kept_light_bit(directional, closeup.light)) != 0u ? count : 0u;
  }
  for (uint i = 0u; i < count && found == GLOAM_NO_FINAL_LIST; ++i) {
    uint entry = entries[first + i];
    if ((entry & 1023u) == closeup.light) found = first + i, slot = entry >> 10;
  }
  return slot == GLOAM_ALL_UNLIT ? GLOAM_NO_FINAL_LIST : found;
}

void main() {
  uvec2 tile = closeup.first_tile + gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(tile, closeup.end_tile))) return;
  uint place = place_of_light(tile);
  if (place == GLOAM_NO_FINAL_LIST) return;
#if GLOAM_SHADOWS_KINDS == 4
  vec3 light_position = vec3(0.0);
#else
  vec3 light_position = fetch_light(light_texels, closeup.light).position;
#endif
  if (subject_is_aside(light_position, tile)) return;
  uint index = atomicAdd(pair_commands[closeup.pair].w, 1u);
  pair_tiles[closeup.first_item + index] = uvec2(tile.y << 16 | tile.x, place);
  if (index == 0u) pair_commands[closeup.pair].xz = uvec2(GLOAM_PAIRS_ROW, 1u);
  if (index % GLOAM_PAIRS_ROW == 0u) atomicAdd(pair_commands[closeup.pair].y, 1u);
}

#endif
