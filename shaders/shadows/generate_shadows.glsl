// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_GENERATE_SHADOWS_GLSL
#define GLOAM_SHADERS_SHADOWS_GENERATE_SHADOWS_GLSL

// Before including this, define GLOAM_SHADOWS_KINDS: 3 for local lights, 4 for directional ones; and GLOAM_SHADOWS_IN_FACE for
// GLOAM_PAIRS_IN_FACE.
//
// Generate shadows (FF XVI paper, §2.2): how much of one light each pixel of a tile sees, into a slot, unless all of them see all of it or
// none sees any. One workgroup is a pair of a tile and a light. Pixels without a surface, or that the light gives nothing, have no say.
//
// Unlike the paper's, a workgroup is one light of a tile, not all of them: pairs cost alike, tiles do not; lavapipe ends all loops of a
// thread after 65,535 turns together. A thread has 64 / kThreads pixels of a row; devices that run threads in turn swap the state of few.

#define GLOAM_SHADOWS_BINDING 12
#define GLOAM_SHADOWS_PIXEL ivec2(0)  // what is traced is shaded without lists
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/pair_places.glsl"
#include "shaders/shadows/shadows_api.glsl"

layout(local_size_x = 64, local_size_x_id = 0) in;  // constant 0: 8, 16, 32 or 64

layout(constant_id = GLOAM_FINAL_BITS_ID) const uint kVisibilityBits = 8u;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 2, scalar) uniform Grid { FinalGrid grid; };
layout(set = 0, binding = 3) uniform sampler2D depth_image;
layout(set = 0, binding = 4) uniform usampler2D normal_image;
layout(set = 0, binding = 5) uniform sampler2D base_color_image;
layout(set = 0, binding = 6) uniform sampler2D light_texels;
layout(set = 0, binding = 7, scalar) readonly buffer Pairs { uint pairs[]; };
layout(set = 0, binding = 8, scalar) buffer Entries { uint entries[]; };
layout(set = 0, binding = 9, scalar) writeonly buffer Visibilities0 { uint visibilities_0[]; };
layout(set = 0, binding = 10, scalar) writeonly buffer Visibilities1 { uint visibilities_1[]; };
layout(set = 0, binding = 11, scalar) buffer Counters { ShadowListCounters counters; };
layout(set = 0, binding = 18, scalar) readonly buffer Commands { ShadowListCommands commands; };

const uint kThreads = gl_WorkGroupSize.x;
const uint kPixels = uint(GLOAM_SLOT_PIXELS) / kThreads;
#if GLOAM_SHADOWS_KINDS == 4
const uint kPairKind = uint(GLOAM_PAIRS_DIRECTIONAL);
#elif defined(GLOAM_SHADOWS_IN_FACE)
const uint kPairKind = uint(GLOAM_PAIRS_IN_FACE);
#else
const uint kPairKind = uint(GLOAM_PAIRS_CROSSING);
#endif
const uint kSomeSeeLess = 1u;
const uint kSomeSeeAny = 2u;

shared uint packed_words[16];
shared float widths[GLOAM_SLOT_PIXELS];  // of penumbrae; each thread has its own pixels
shared uint found;  // kSome… of all pixels
shared uint slot;

// A pixel of the tile and the light.
struct PixelOfPair {
  ShadowPoint point;
  bool matters;  // the light gives the pixel anything
};

// What is the same for all pixels of a pair.
#if GLOAM_SHADOWS_KINDS == 4
struct LightOfPair {
  uint light;
  float brightest;
  vec3 direction;
};

LightOfPair light_of_pair(uint light) {
  return LightOfPair(light, fetch_sun(light).w, texelFetch(shadow_rows, ivec2(6, cascade_row(light, 0u)), 0).xyz);
}

ShadowPoint shadow_point(LightOfPair l, ShadowReceiver r) { return directional_shadow_point(l.light, l.direction, r); }

bool gives_light(LightOfPair l, vec3 position, vec3 normal) { return l.brightest > 0.0 && dot(normal, -l.direction) > 0.0; }
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

bool gives_light(LightOfPair l, vec3 position, vec3 normal) {
  vec3 to_light;
  vec3 illuminance = local_illuminance(l.light, position, to_light);
  return max(illuminance.r, max(illuminance.g, illuminance.b)) > 0.0 && dot(normal, to_light) > 0.0;
}
#endif

PixelOfPair pixel_of_pair(LightOfPair light, uvec2 pixel) {
  ivec2 at = ivec2(min(pixel, view.size - 1u));
  float depth = texelFetch(depth_image, at, 0).r;
  ShadowReceiver r;
  r.position = relative_position(view, vec2(at), max(depth, 1e-9));
  uvec2 normals = texelFetch(normal_image, at, 0).xy;
  r.face_normal = unpack_normal(normals.y);
  r.subsurface = texelFetch(base_color_image, at, 0).a > 0.5;
  PixelOfPair p;
  p.matters = depth > 0.0 && all(lessThan(pixel, view.size)) && gives_light(light, r.position, unpack_normal(normals.x));
  p.point = shadow_point(light, r);
  p.point.live = p.point.live && p.matters;
  return p;
}

// Keeps what a pixel sees; returns what it says of the tile.
uint keep_visibility(uint pixel, PixelOfPair p, float visibility) {
  const uint most = (1u << kVisibilityBits) - 1u;
  uint steps = uint(quantised_visibility(visibility * p.point.horizon) * float(most) + 0.5);
  if (!p.matters) return 0u;
  atomicOr(packed_words[pixel * kVisibilityBits >> 5], steps << (pixel * kVisibilityBits & 31u));
  return (steps < most ? kSomeSeeLess : 0u) | (steps > 0u ? kSomeSeeAny : 0u);
}

uvec2 pixel_at(uvec2 tile, uint pixel) { return tile * uint(GLOAM_SHADOW_TILE) + uvec2(pixel & 7u, pixel >> 3); }

// All pixels of a thread, first as far as it goes without the filter; then those that need it, which are one after the other in every
// thread: devices that run threads side by side take as many turns as the thread with the most of them.
void ask_pixels(LightOfPair light, uvec2 tile, uint lane) {
  uint some = 0u, left = 0u, i = 0u;
  do {
    uint pixel = lane * kPixels + i;
    PixelOfPair p = pixel_of_pair(light, pixel_at(tile, pixel));
    bool known = true;
    float visibility, width = 0.0;
    if (kFilter == 3u) known = known_before_filter(p.point, visibility, width) || !p.matters;
    else visibility = unquantised_visibility(p.point);
    widths[pixel] = width;
    left |= known ? 0u : 1u << i;
    if (known) some |= keep_visibility(pixel, p, visibility);
  } while (++i < kPixels);
  if (kFilter == 3u && left != 0u) do {
    uint pixel = lane * kPixels + uint(findLSB(left));
    PixelOfPair p = pixel_of_pair(light, pixel_at(tile, pixel));
    some |= keep_visibility(pixel, p, filtered_visibility(p.point, widths[pixel]));
    left &= left - 1u;
  } while (left != 0u);
  if (some != 0u) atomicOr(found, some);
}

// What the entry becomes; counts it.
uint take_slot(uint some) {
  if (some == (kSomeSeeLess | kSomeSeeAny)) {
    uint taken = atomicAdd(counters.slots, 1u);
    return taken < grid.slot_capacity ? taken : GLOAM_NO_ROOM;
  }
  // Pixels that the light gives nothing are no reason to look at it.
  bool lit = some == kSomeSeeAny;
  if (lit) atomicAdd(counters.lit_by_filter, 1u);
  else atomicAdd(counters.unlit_by_filter, 1u);
  return lit ? GLOAM_ALL_LIT : GLOAM_ALL_UNLIT;
}

void main() {
  uint pair = gl_WorkGroupID.y * uint(GLOAM_PAIRS_ROW) + gl_WorkGroupID.x;
  uint asked = commands.pairs[kPairKind].w;
  if (pair >= asked) return;  // the same for the whole workgroup
  uint lane = gl_LocalInvocationIndex;
  for (uint i = lane; i < 16u; i += kThreads) packed_words[i] = 0u;
  if (lane == 0u) found = 0u;
  barrier();
  uint at = pairs[pair_place(grid, kPairKind, pair)];
  uint entry = entries[at], light = entry & 1023u, tile_index = entry >> 10;
  ask_pixels(light_of_pair(light), uvec2(tile_index % grid.tiles.x, tile_index / grid.tiles.x), lane);
  barrier();
  if (lane == 0u) {
    slot = take_slot(found);
    entries[at] = light | slot << 10;
  }
  barrier();
  if (slot >= GLOAM_NO_ROOM) return;
  const uint words = 2u * kVisibilityBits, per_buffer = GLOAM_BUFFER_WORDS / words;
  for (uint i = lane; i < words; i += kThreads) {
    if (slot < per_buffer) visibilities_0[slot * words + i] = packed_words[i];
    else visibilities_1[(slot - per_buffer) * words + i] = packed_words[i];
  }
}

#endif
