// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_CLOSEUPS_COMPOSE_GLSL
#define GLOAM_SHADERS_CLOSEUPS_COMPOSE_GLSL

// Before including this, define GLOAM_SHADOWS_KINDS: 1 for local lights, 4 for directional ones.
//
// Compose (FF XVI paper, §3.4): lowers the visibilities of one light in the final lists to the share that a close-up
// map leaves. One workgroup per tile of the pair's umbra range. A tile that does not list the light, or is already
// unlit by it, stays unchanged; pixels outside the close-up face keep their visibility. The other pixels get the lesser
// of old visibility and close-up visibility. An entry that was lit for the whole tile gets a visibility slot; an entry
// whose last visible pixel becomes unlit is set to GLOAM_ALL_UNLIT. If no slot is left, the tile loses its final list
// and becomes a fallback tile.

#define GLOAM_SHADOWS_BINDING 12
#define GLOAM_SHADOWS_PIXEL ivec2(0)  // unused: traced visibility is shaded without final lists
#include "shaders/closeups/closeups_shared.h"
#include "shaders/shadows/pair_pixels_api.glsl"

layout(set = 0, binding = 1, scalar) uniform Closeup { CloseupConstants closeup; };
layout(set = 0, binding = 2, scalar) uniform Grid { FinalGrid final_grid; };
layout(set = 0, binding = 7, rgba32ui) uniform uimage2D final_tiles;
layout(set = 0, binding = 8, scalar) buffer Entries { uint entries[]; };
layout(set = 0, binding = 9, scalar) buffer Visibilities0 { uint visibilities_0[]; };
layout(set = 0, binding = 10, scalar) buffer Visibilities1 { uint visibilities_1[]; };
layout(set = 0, binding = 11, scalar) buffer Counters { ShadowListCounters counters; };
layout(set = 0, binding = 18, scalar) buffer Commands { ShadowListCommands commands; };
layout(set = 0, binding = 20) uniform sampler2D depth_bounds;
layout(set = 0, binding = 19, scalar) writeonly buffer FallbackTiles { uint fallback_tiles[]; };
layout(set = 0, binding = 23, scalar) writeonly buffer KeptTiles { KeptTile kept_tiles[]; };

layout(constant_id = 33) const uint kReuse = 0u;  // 1: there are kept tiles

#include "shaders/shadows/slots_api.glsl"

const uint kSomeChanged = 4u;
const uint kNoEntry = 0xFFFFFFFFu;
const uint kWords = 2u * kVisibilityBits;
const uint kSlotsPerBuffer = GLOAM_BUFFER_WORDS / kWords;

shared uint place;          // index of the light's entry in `entries`
shared uint slot;           // the entry's slot before, then after
shared uint old_words[16];  // its visibilities before

#include "shaders/closeups/light_of_pair.glsl"

#if GLOAM_SHADOWS_KINDS == 4
// Homogeneous position in the face: x and y in texels, z is the depth; w is 1.
vec4 place_in_face(LightOfPair l, vec3 position) {
  vec4 p = vec4(position, 1.0);
  return vec4(dot(closeup.row_u, p), dot(closeup.row_v, p), dot(closeup.row_depth, p), 1.0);
}

float penumbra_texels() { return closeup.penumbra_m_per_m * closeup.depth_m / closeup.texel_m; }

float light_cosine(LightOfPair l, vec3 position, vec3 normal) {
  return sun_cosine(closeup.brightest, closeup.direction, normal);
}
#else
// Homogeneous position in the face: x and y in texels, z is the depth, all times w. w: metres in front of the light,
// must be > 0.
vec4 place_in_face(LightOfPair l, vec3 position) {
  vec3 v = position - l.light.position;
  float z = dot(v, cross(closeup.up, closeup.right)), texels = 0.5 * closeup.size / closeup.tan_half;
  return vec4(dot(v, closeup.right) * texels + 0.5 * closeup.size * z,
              -dot(v, closeup.up) * texels + 0.5 * closeup.size * z, closeup.near_m, z);
}

// Width of a penumbra in texels, per unit of depth between blocker and receiver.
float penumbra_texels() {
  return closeup.emitter_diameter_m * closeup.size / (closeup.near_m * 2.0 * closeup.tan_half);
}

float light_cosine(LightOfPair l, vec3 position, vec3 normal) { return local_light_cosine(l.light, position, normal); }
#endif

// The lesser of the pixel's old visibility and the close-up visibility, in `steps`; returns the pixel's flags. Of two
// transmittances the lesser is that of the nearer depth, as if one map held both.
uint keep_visibility(uint pixel, PixelOfPair p, float visibility, out uint steps) {
  uint old = old_words[pixel * kVisibilityBits >> 5] >> (pixel * kVisibilityBits & 31u) & kMostSteps;
  steps = p.point.live ? min(visibility_steps(p, visibility), old) : old;
  if (!p.matters) return 0u;
  return (steps < kMostSteps ? kSomeSeeLess : 0u) | (steps > 0u ? kSomeSeeAny : 0u) | (steps < old ? kSomeChanged : 0u);
}

#include "shaders/shadows/pair_pixels_asked_api.glsl"

// Whether the subject certainly hides no light from any pixel of the tile: the tile is outside the face, or no depth in
// the face is near enough to the paths between the tile and the emitter.
bool subject_is_aside(LightOfPair light, uvec2 tile) {
  vec2 bounds = texelFetch(depth_bounds, ivec2(tile), 0).xy;
  if (bounds.y <= 0.0) return true;
  vec2 begin = vec2(tile * uint(GLOAM_SHADOW_TILE)) - 0.5,
       end = min(begin + float(GLOAM_SHADOW_TILE), vec2(view.size) - 0.5);
  vec2 low = vec2(1e30), high = vec2(-1e30);
  bvec4 outside = bvec4(true);
  float farthest = 1e30, least_w = 1e30, most_w = 0.0;
  for (int i = 0; i < 8; ++i) {
    vec2 pixel = vec2((i & 1) != 0 ? end.x : begin.x, (i & 2) != 0 ? end.y : begin.y);
    vec4 at = place_in_face(light, relative_position(view, pixel, i < 4 ? bounds.x : bounds.y));
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
  float nearest = 1.0;
  for (int step = 0; step < 2; ++step) {
    // Wider than the reach of any kernel of a penumbra this wide.
    float reach = 2.0 * clamp(penumbra_texels() * (nearest - farthest), 0.0, closeup.size) + 14.0, unused;
    nearest = nearest_in_face(closeup.origin, closeup.size, low - reach, high + reach, unused);
  }
  return nearest <= 0.999 * farthest;
}

// The threads share the search through the tile's list.
void find_entry(uvec3 list, uint lane) {
#if GLOAM_SHADOWS_KINDS == 4
  uint first = list.x, count = list.z >> 16;
#else
  uint first = list.y, count = list.z & 0xFFFFu;
#endif
  for (uint i = lane; i < count; i += kThreads) {
    uint entry = entries[first + i];
    if ((entry & 1023u) != closeup.light) continue;
    place = first + i;
    slot = entry >> 10;
  }
}

void load_slot(uint lane) {
  for (uint i = lane; i < kWords; i += kThreads) {
    uint at = (slot % kSlotsPerBuffer) * kWords + i;
    old_words[i] = slot >= GLOAM_NO_ROOM    ? 0xFFFFFFFFu
                   : slot < kSlotsPerBuffer ? visibilities_0[at]
                                            : visibilities_1[at];
  }
}

// Removes the tile's final list and makes it a fallback tile.
void give_tile_up(uvec2 tile) {
  imageStore(final_tiles, ivec2(tile), uvec4(GLOAM_NO_FINAL_LIST, GLOAM_NO_FINAL_LIST, 0u, 0u));
  fallback_tiles[atomicAdd(commands.fallback_draw.y, 1u)] = tile.y << 16 | tile.x;
  atomicAdd(counters.fallback_tiles, 1u);
}

// The entry's new slot; GLOAM_ALL_UNLIT; or GLOAM_NO_ROOM if nothing is to be stored.
uint changed_slot(uvec2 tile, uint some) {
  if ((some & kSomeChanged) == 0u) return GLOAM_NO_ROOM;
  if ((some & kSomeSeeAny) == 0u) return GLOAM_ALL_UNLIT;
  if (slot < GLOAM_NO_ROOM) return slot;
  // All tiles of umbra ranges are reserved, if any are.
  uint taken = take_free_slot(final_grid.reserved_slots != 0u);
  if (taken == GLOAM_NO_ROOM) give_tile_up(tile);
  return taken;
}

void main() {
  uvec2 tile = closeup.first_tile + gl_WorkGroupID.xy;
  uint lane = gl_LocalInvocationIndex;
  uvec3 list = imageLoad(final_tiles, ivec2(tile)).xyz;
  if (lane == 0u) place = kNoEntry;
  if (lane == 0u) slot = GLOAM_ALL_UNLIT;
  start_pixels(lane);
  barrier();
  if (list.y != GLOAM_NO_FINAL_LIST) find_entry(list, lane);
  barrier();
  // Uniform over the workgroup.
  if (place == kNoEntry || slot == GLOAM_ALL_UNLIT) return;
  LightOfPair light = light_of_pair();
  if (subject_is_aside(light, tile)) return;
  load_slot(lane);
  barrier();
  ask_pixels(light, tile, lane);
  barrier();
  if (lane == 0u) {
    slot = changed_slot(tile, found);
    // The next frame must not keep what is composed here.
    if (kReuse != 0u && (found & kSomeChanged) != 0u)
      kept_tiles[tile.y * final_grid.tiles.x + tile.x].local_first = GLOAM_NO_FINAL_LIST;
    if (slot != GLOAM_NO_ROOM) entries[place] = closeup.light | slot << 10;
  }
  barrier();
  if (slot >= GLOAM_NO_ROOM) return;
  for (uint i = lane; i < kWords; i += kThreads) {
    if (slot < kSlotsPerBuffer)
      visibilities_0[slot * kWords + i] = packed_words[i];
    else
      visibilities_1[(slot - kSlotsPerBuffer) * kWords + i] = packed_words[i];
  }
}

#endif
