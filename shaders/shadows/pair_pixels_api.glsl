// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_PAIR_PIXELS_API_GLSL
#define GLOAM_SHADERS_SHADOWS_PAIR_PIXELS_API_GLSL

#include "shaders/lights/lights_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/final_lists_shared.h"
#include "shaders/shadows/shadows_api.glsl"

// How much of a light the pixels of a shadow tile see: one workgroup is a tile and a light, a thread has kPixels pixels
// of a row. Before including this, include what shadows_api.glsl asks for; afterwards define
//   LightOfPair: what is the same for all pixels, with
//   ShadowPoint shadow_point(LightOfPair l, ShadowReceiver r) and
//   bool gives_light(LightOfPair l, vec3 position, vec3 normal),
//   uint keep_visibility(uint pixel, PixelOfPair p, float visibility, out uint steps), which returns what it says of
//   the tile, and steps to keep,
// and include pair_pixels_asked_api.glsl. Bindings 0 and 3 to 6 are taken.

layout(local_size_x = 64, local_size_x_id = 0) in;  // constant 0: 8, 16, 32 or 64

layout(constant_id = GLOAM_FINAL_BITS_ID) const uint kVisibilityBits = 8u;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 3) uniform sampler2D depth_image;
layout(set = 0, binding = 4) uniform usampler2D normal_image;
layout(set = 0, binding = 5) uniform sampler2D base_color_image;
layout(set = 0, binding = 6) uniform sampler2D light_texels;

const uint kThreads = gl_WorkGroupSize.x;
const uint kPixels = uint(GLOAM_SLOT_PIXELS) / kThreads;
const uint kMostSteps = (1u << kVisibilityBits) - 1u;
const uint kSomeSeeLess = 1u;
const uint kSomeSeeAny = 2u;

shared uint packed_words[16];             // of a slot
shared float widths[GLOAM_SLOT_PIXELS];   // of penumbrae
shared uint filtered[GLOAM_SLOT_PIXELS];  // pixels that need the filter, filtered_count of them
shared uint filtered_count;
shared uint found;  // what all pixels say of the tile
// Of threads whose pixels fill words of their own: those words, one or two. Others share theirs.
const bool kOwnWords = kPixels * kVisibilityBits >= 32u;
uvec2 own_words = uvec2(0u);

// A pixel of the tile and the light.
struct PixelOfPair {
  ShadowPoint point;
  bool matters;  // the light gives the pixel anything
};

// Whether a light gives anything to a surface there.
bool local_light_gives(LocalLight light, vec3 position, vec3 normal) {
  vec3 to_light;
  vec3 illuminance = local_illuminance(light, position, to_light);
  return max(illuminance.r, max(illuminance.g, illuminance.b)) > 0.0 && dot(normal, to_light) > 0.0;
}

// brightest: lux. direction: where it shines.
bool sun_gives(float brightest, vec3 direction, vec3 normal) {
  return brightest > 0.0 && dot(normal, -direction) > 0.0;
}

// Steps of visibility: 0 … kMostSteps.
uint visibility_steps(PixelOfPair p, float visibility) {
  return uint(quantised_visibility(visibility * p.point.horizon) * float(kMostSteps) + 0.5);
}

void pack_steps(uint pixel, uint steps) {
  atomicOr(packed_words[pixel * kVisibilityBits >> 5], steps << (pixel * kVisibilityBits & 31u));
}

// Of one of the thread's own pixels.
void pack_own_steps(uint pixel, uint steps) {
  if (!kOwnWords) pack_steps(pixel, steps);
  uint bit = pixel * kVisibilityBits, placed = steps << (bit & 31u);
  bool second = kPixels * kVisibilityBits > 32u && (bit & 32u) != 0u;
  own_words |= uvec2(second ? 0u : placed, second ? placed : 0u);
}

// After the last pixel of a thread.
void keep_own_words(uint lane) {
  if (!kOwnWords) return;
  uint words = kPixels * kVisibilityBits / 32u;
  packed_words[lane * words] = own_words.x;
  if (words > 1u) packed_words[lane * words + 1u] = own_words.y;
}

void start_pixels(uint lane) {
  for (uint i = lane; i < 16u; i += kThreads) packed_words[i] = 0u;
  if (lane == 0u) found = filtered_count = 0u;
}

#endif
