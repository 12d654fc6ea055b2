// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_CLOSEUPS_COMPOSE_GLSL
#define GLOAM_SHADERS_CLOSEUPS_COMPOSE_GLSL

// Before including this, define GLOAM_SHADOWS_KINDS: 1 for local lights, 4 for directional ones.
//
// Compose (FF XVI paper, §3.4): lowers the visibilities of one light in the final lists to the share that a close-up
// map leaves. One workgroup per tile that tiles.glsl has listed. A tile that an earlier pair has made unlit stays
// unchanged; pixels outside the close-up face keep their visibility. The other pixels get the lesser of old visibility
// and close-up visibility, so composing again changes nothing. An entry that was lit for the whole tile gets a
// visibility slot; an entry whose last visible pixel becomes unlit is set to GLOAM_ALL_UNLIT. If no slot is left, the
// tile loses its final list and becomes a fallback tile.

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
layout(set = 0, binding = 19, scalar) writeonly buffer FallbackTiles { uint fallback_tiles[]; };
layout(set = 0, binding = 20, scalar) readonly buffer PairCommands { uvec4 pair_commands[]; };
layout(set = 0, binding = 23, scalar) buffer KeptTiles { KeptTile kept_tiles[]; };
layout(set = 0, binding = 24, scalar) readonly buffer PairTiles { uvec2 pair_tiles[]; };

layout(constant_id = 33) const uint kReuse = 0u;  // 1: there are kept tiles

#include "shaders/shadows/kept_tiles_api.glsl"
#include "shaders/shadows/slots_api.glsl"

const uint kSomeChanged = 4u;
const uint kWords = 2u * kVisibilityBits;
const uint kSlotsPerBuffer = GLOAM_BUFFER_WORDS / kWords;

shared uint slot;           // the entry's slot before, then after
shared uint old_words[16];  // its visibilities before

#include "shaders/closeups/light_of_pair.glsl"

#if GLOAM_SHADOWS_KINDS == 4
float light_cosine(LightOfPair l, vec3 position, vec3 normal) {
  return sun_cosine(closeup.brightest, closeup.direction, normal);
}
#else
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
  if (kReuse != 0u) kept_tiles[tile.y * final_grid.tiles.x + tile.x].local_first = GLOAM_NO_FINAL_LIST;
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
  uint index = gl_WorkGroupID.y * uint(GLOAM_PAIRS_ROW) + gl_WorkGroupID.x;
  // Uniform over the workgroup, like the next condition.
  if (index >= pair_commands[closeup.pair].w) return;
  uvec2 item = pair_tiles[closeup.first_item + index], tile = uvec2(item.x & 0xFFFFu, item.x >> 16);
  uint lane = gl_LocalInvocationIndex, place = item.y, old_slot = entries[place] >> 10;
  if (old_slot == GLOAM_ALL_UNLIT || imageLoad(final_tiles, ivec2(tile)).y == GLOAM_NO_FINAL_LIST) return;
  if (lane == 0u) slot = old_slot;
  start_pixels(lane);
  barrier();
  LightOfPair light = light_of_pair();
  load_slot(lane);
  barrier();
  ask_pixels(light, tile, lane);
  barrier();
  if (lane == 0u) {
    slot = changed_slot(tile, found);
    if (kReuse != 0u && (found & kSomeChanged) != 0u)
      kept_tiles[tile.y * final_grid.tiles.x + tile.x].composed |=
          kept_light_bit(GLOAM_SHADOWS_KINDS == 4, closeup.light);
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
