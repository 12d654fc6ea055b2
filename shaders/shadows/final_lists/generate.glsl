// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_GENERATE_SHADOWS_GLSL
#define GLOAM_SHADERS_SHADOWS_GENERATE_SHADOWS_GLSL

// Generates visibilities (FF XVI paper, §2.2): how much of one light each pixel of a tile sees. The result is a
// visibility slot, unless all pixels see the whole light or none sees any. Each workgroup processes one tile-light
// pair. Pixels without a surface, and pixels that the light does not illuminate, do not count.
//
// Unlike in the paper, a workgroup processes only one light of a tile. The cost of pairs is similar, while the cost of
// tiles varies; and lavapipe ends the loops of a thread after 65,535 iterations in total. Each thread processes 64 /
// kThreads consecutive pixels of the tile. On lavapipe the threads of a workgroup run one after another and each
// barrier swaps all their state, so fewer threads are faster.
//
// Before including this, define GLOAM_SHADOWS_KINDS: 3 for local lights, 4 for directional ones; and
// GLOAM_SHADOWS_IN_FACE for GLOAM_PAIRS_IN_FACE.

#define GLOAM_SHADOWS_BINDING 12
#define GLOAM_SHADOWS_PIXEL ivec2(0)  // unused: frames with traced visibility have no lists
#include "shaders/shadows/pair_pixels_api.glsl"
#include "shaders/shadows/final_lists/pair_places.glsl"

layout(set = 0, binding = 2, scalar) uniform Grid { FinalGrid final_grid; };
layout(set = 0, binding = 7, scalar) readonly buffer Pairs { uint pairs[]; };
layout(set = 0, binding = 8, scalar) buffer Entries { uint entries[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer Visibilities0 { uint visibilities_0[]; };
layout(set = 0, binding = 10, scalar) writeonly buffer Visibilities1 { uint visibilities_1[]; };
layout(set = 0, binding = 11, scalar) buffer Counters { ShadowListCounters counters; };
layout(set = 0, binding = 18, scalar) readonly buffer Commands { ShadowListCommands commands; };
// Bit i % 32 of word i / 32: tile i is reserved. One word if no tile is.
layout(set = 0, binding = 19, scalar) readonly buffer ReservedTiles { uint reserved_tiles[]; };

#include "shaders/shadows/final_lists/reserved_tiles.glsl"

#if GLOAM_SHADOWS_KINDS == 4
const uint kPairKind = uint(GLOAM_PAIRS_DIRECTIONAL);
#elif defined(GLOAM_SHADOWS_IN_FACE)
const uint kPairKind = uint(GLOAM_PAIRS_IN_FACE);
#else
const uint kPairKind = uint(GLOAM_PAIRS_CROSSING);
#endif
shared uint slot;
shared uint few_that_matter;  // bit i: few_pixel(i) matters

// The values that all pixels of a pair share.
#if GLOAM_SHADOWS_KINDS == 4
struct LightOfPair {
  SunShadow shadow;
};

LightOfPair light_of_pair(uint light) { return LightOfPair(fetch_sun_shadow(light)); }

ShadowPoint shadow_point(LightOfPair l, ShadowReceiver r) { return directional_shadow_point(l.shadow, r); }

float light_cosine(LightOfPair l, vec3 position, vec3 normal) {
  return sun_cosine(l.shadow.sun.w, l.shadow.direction, normal);
}
#else
struct LightOfPair {
  LocalShadow shadow;
  LocalLight light;
};

LightOfPair light_of_pair(uint light) {
  LocalLight local = fetch_light(light_texels, light);
  return LightOfPair(fetch_local_shadow(light, local.position), local);
}

ShadowPoint shadow_point(LightOfPair l, ShadowReceiver r) { return local_shadow_point(l.shadow, r); }

float light_cosine(LightOfPair l, vec3 position, vec3 normal) { return local_light_cosine(l.light, position, normal); }
#endif

uint keep_visibility(uint pixel, PixelOfPair p, float visibility, out uint steps) {
  steps = p.matters ? visibility_steps(p, visibility) : 0u;
  if (!p.matters) return 0u;
  if (kDimLights != 0u) atomicOr(few_that_matter, 1u << (pixel >> 3));
  return (steps < kMostSteps ? kSomeSeeLess : 0u) | (steps > 0u ? kSomeSeeAny : 0u);
}

// In pairs within a face, the list would cost more than the pixels that it leaves out.
#ifdef GLOAM_SHADOWS_CROSSING
#define GLOAM_PAIR_LISTS_PIXELS
#endif
#include "shaders/shadows/pair_pixels_asked_api.glsl"

// Gives all pixels of a dim light's tile the mean of the pixels that were asked. Returns the combined flags.
uint spread_mean() {
  uint sum = 0u, count = uint(bitCount(few_that_matter));
  for (uint row = 0u; row < uint(GLOAM_DIM_PIXELS); ++row) {
    uint bit = few_pixel(row) * kVisibilityBits;
    sum += packed_words[bit >> 5] >> (bit & 31u) & kMostSteps;
  }
  if (count == 0u) return 0u;
  uint mean = (2u * sum + count) / (2u * count), word = mean * (0xFFFFFFFFu / kMostSteps);
  for (uint i = 0u; i < 2u * kVisibilityBits; ++i) packed_words[i] = word;
  return (mean < kMostSteps ? kSomeSeeLess : 0u) | (mean > 0u ? kSomeSeeAny : 0u);
}

// Takes the final slot of the pair's entry and counts the result. some: combined flags of all pixels.
uint take_slot(uint some, uint tile_index) {
  if (some == (kSomeSeeLess | kSomeSeeAny)) return take_free_slot_of(tile_index);
  // If no flag is set, the light illuminates no pixel of the tile: unlit.
  bool lit = some == kSomeSeeAny;
  if (lit)
    atomicAdd(counters.lit_by_filter, 1u);
  else
    atomicAdd(counters.unlit_by_filter, 1u);
  return lit ? GLOAM_ALL_LIT : GLOAM_ALL_UNLIT;
}

void main() {
  uint pair = gl_WorkGroupID.y * uint(GLOAM_PAIRS_ROW) + gl_WorkGroupID.x;
  uint asked = commands.pairs[kPairKind].w;
  if (pair >= asked) return;  // the same for the whole workgroup
  uint lane = gl_LocalInvocationIndex;
  start_pixels(lane);
  if (lane == 0u) few_that_matter = 0u;
  barrier();
  uint word = pairs[pair_place(final_grid, kPairKind, pair)], at = word & ~GLOAM_ENTRY_FLAGS;
  asks_few = kDimLights != 0u && (word & GLOAM_DIM_LIGHT) != 0u;
  leaves_out_pixels = (word & GLOAM_PARTLY_REACHED) != 0u;
  uint entry = entries[at], light = entry & 1023u, tile_index = entry >> 10;
  ask_pixels(light_of_pair(light), uvec2(tile_index % final_grid.tiles.x, tile_index / final_grid.tiles.x), lane);
  barrier();
  if (lane == 0u) {
    if (asks_few) found = spread_mean();
    slot = take_slot(found, tile_index);
    entries[at] = light | slot << 10;
  }
  barrier();
  if (slot >= GLOAM_NO_ROOM) return;
  const uint words = 2u * kVisibilityBits, per_buffer = GLOAM_BUFFER_WORDS / words;
  for (uint i = lane; i < words; i += kThreads) {
    if (slot < per_buffer)
      visibilities_0[slot * words + i] = packed_words[i];
    else
      visibilities_1[(slot - per_buffer) * words + i] = packed_words[i];
  }
}

#endif
