// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_GENERATE_SHADOWS_GLSL
#define GLOAM_SHADERS_SHADOWS_GENERATE_SHADOWS_GLSL

// Generate shadows (FF XVI paper, §2.2): how much of one light each pixel of a tile sees, into a slot, unless all of them see all of it or
// none sees any. One workgroup is a pair of a tile and a light. Pixels without a surface, or that the light gives nothing, have no say.
//
// Unlike the paper's, a workgroup is one light of a tile, not all of them: pairs cost alike, tiles do not; lavapipe ends all loops of a
// thread after 65,535 turns together. A thread has 64 / kThreads pixels of a row; devices that run threads in turn swap the state of few.

#define GLOAM_SHADOWS_BINDING 12
ivec2 generated_pixel;
#define GLOAM_SHADOWS_PIXEL generated_pixel
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/final_lists_shared.h"
#include "shaders/shadows/shadows_api.glsl"

layout(local_size_x = 64, local_size_x_id = 0) in;  // constant 0: 8, 16, 32 or 64

layout(constant_id = GLOAM_FINAL_BITS_ID) const uint kVisibilityBits = 8u;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Lights { LightBlock lights; };
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

const uint kThreads = gl_WorkGroupSize.x;
const uint kPixels = uint(GLOAM_SLOT_PIXELS) / kThreads;
const uint kSomeSeeLess = 1u;
const uint kSomeSeeAny = 2u;

shared uint packed_words[16];
shared uint found;  // kSome… of all pixels
shared uint slot;

// Visibility in steps of the slot; `matters`: the light gives the pixel anything.
uint pixel_steps(bool directional, uint light, uvec2 pixel, out bool matters) {
  generated_pixel = ivec2(min(pixel, view.size - 1u));
  float depth = texelFetch(depth_image, generated_pixel, 0).r;
  ShadowReceiver r;
  r.position = relative_position(view, vec2(generated_pixel), max(depth, 1e-9));
  uvec2 normals = texelFetch(normal_image, generated_pixel, 0).xy;
  r.face_normal = unpack_normal(normals.y);
  r.subsurface = texelFetch(base_color_image, generated_pixel, 0).a > 0.5;
  LocalLight local = fetch_light(light_texels, directional ? 0u : light);
  vec3 to_light;
  vec3 illuminance = local_illuminance(local, r.position, to_light);
  vec3 light_vector = local.position;
  if (directional) {
    illuminance = lights.directional[light & 15u].color;
    light_vector = lights.directional[light & 15u].direction;
    to_light = -light_vector;
  }
  matters = depth > 0.0 && all(lessThan(pixel, view.size)) && max(illuminance.r, max(illuminance.g, illuminance.b)) > 0.0 &&
            dot(unpack_normal(normals.x), to_light) > 0.0;
  float visibility = light_visibility(directional, light, light_vector, r);
  return uint(visibility * float((1u << kVisibilityBits) - 1u) + 0.5);
}

void ask_pixels(bool directional, uint light, uvec2 tile, uint lane) {
  const uint most = (1u << kVisibilityBits) - 1u;
  uint some = 0u;
  uint p = 0u;
  do {
    uint pixel = lane * kPixels + p;
    bool matters;
    uint steps = pixel_steps(directional, light, tile * uint(GLOAM_SHADOW_TILE) + uvec2(pixel & 7u, pixel >> 3), matters);
    some |= matters ? (steps < most ? kSomeSeeLess : 0u) | (steps > 0u ? kSomeSeeAny : 0u) : 0u;
    atomicOr(packed_words[pixel * kVisibilityBits >> 5], (matters ? steps : 0u) << (pixel * kVisibilityBits & 31u));
  } while (++p < kPixels);
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
  if (pair >= min(counters.pairs, grid.pair_capacity)) return;  // the same for the whole workgroup
  uint lane = gl_LocalInvocationIndex;
  for (uint i = lane; i < 16u; i += kThreads) packed_words[i] = 0u;
  if (lane == 0u) found = 0u;
  barrier();
  bool directional = (pairs[pair] & GLOAM_PAIR_DIRECTIONAL) != 0u;
  uint at = pairs[pair] & ~GLOAM_PAIR_DIRECTIONAL;
  uint entry = entries[at], light = entry & 1023u, tile_index = entry >> 10;
  ask_pixels(directional, light, uvec2(tile_index % grid.tiles.x, tile_index / grid.tiles.x), lane);
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
