// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_PAIR_PIXELS_API_GLSL
#define GLOAM_SHADERS_SHADOWS_PAIR_PIXELS_API_GLSL

#define GLOAM_SMOOTH_SURFACE_BINDING 21
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/gbuffer_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/final_lists_shared.h"
#include "shaders/shadows/shadows_api.glsl"

// Evaluates how much of a light each pixel of a shadow tile sees. One workgroup processes one tile and one light; each
// thread processes kPixels consecutive pixels (slot_pixel order). Before including this, define what shadows_api.glsl
// requires. Afterwards define
//   struct LightOfPair: the values that all pixels share,
//   ShadowPoint shadow_point(LightOfPair l, ShadowReceiver r),
//   float light_cosine(LightOfPair l, vec3 position, vec3 normal), see local_light_cosine(), and
//   uint keep_visibility(uint pixel, PixelOfPair p, float visibility, out uint steps), which gets a pixel's visibility
//     and returns flags that are combined into `found`, and the steps to store in the slot,
// and include pair_pixels_asked_api.glsl. Uses bindings 0, 3 to 6, 21 and 22. For pixels that the light falls on from
// behind, and whose material lets light through, visibility means transmittance.

layout(local_size_x = 64, local_size_x_id = 0) in;  // 8, 16, 32 or 64

layout(constant_id = 19) const uint kVisibilityBits = 8u;  // bits of a visibility: 8 or 4

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 3) uniform sampler2D depth_image;
layout(set = 0, binding = 4) uniform usampler2D normal_image;
layout(set = 0, binding = 5) uniform sampler2D base_color_image;
layout(set = 0, binding = 6) uniform sampler2D light_texels;
layout(set = 0, binding = 22) uniform sampler2D emissive_image;

const uint kThreads = gl_WorkGroupSize.x;
const uint kPixels = uint(GLOAM_SLOT_PIXELS) / kThreads;
const uint kMostSteps = (1u << kVisibilityBits) - 1u;
const uint kSomeSeeLess = 1u;
const uint kSomeSeeAny = 2u;

shared uint packed_words[16];            // words of the slot
shared float widths[GLOAM_SLOT_PIXELS];  // penumbra width by pixel
// Pixels that need the filter, filtered_count of them; from the end back, those that take light from behind.
shared uint filtered[GLOAM_SLOT_PIXELS];
shared uint filtered_count;
shared uint near_pixels[GLOAM_SLOT_PIXELS];  // near_count pixels with near blockers; from bit 8 on, their sectors
shared uint near_count;
shared uint behind_count;
// With kThinFilter: the pixels, other_count of them; from the end back, those of thin surfaces, thin_count of them.
shared uint listed[GLOAM_SLOT_PIXELS];
shared uint other_count;
shared uint thin_count;
shared uint found;  // combined flags of all pixels
// Whether the pixels of a thread fill one or two whole words of the slot. The thread then builds these in own_words;
// otherwise several threads share a word.
const bool kOwnWords = kPixels * kVisibilityBits >= 32u;
uvec2 own_words = uvec2(0u);

// A pixel of the tile, seen from the light.
struct PixelOfPair {
  ShadowPoint point;
  bool matters;        // the light would illuminate the pixel without shadows
  float extinction_m;  // extinction_behind()
};

// Cosine between a surface's normal and the direction to a light; 0 if the light does not reach the surface.
float local_light_cosine(LocalLight light, vec3 position, vec3 normal) {
  vec3 to_light;
  vec3 illuminance = local_illuminance(light, position, to_light);
  return max(illuminance.r, max(illuminance.g, illuminance.b)) > 0.0 ? dot(normal, to_light) : 0.0;
}

// The same for a directional light. brightest: lux. direction: the way it shines.
float sun_cosine(float brightest, vec3 direction, vec3 normal) {
  return brightest > 0.0 ? dot(normal, -direction) : 0.0;
}

// Steps of visibility: 0 … kMostSteps.
uint visibility_steps(PixelOfPair p, float visibility) {
  return uint(quantised_visibility(visibility * p.point.horizon) * float(kMostSteps) + 0.5);
}

void pack_steps(uint pixel, uint steps) {
  atomicOr(packed_words[pixel * kVisibilityBits >> 5], steps << (pixel * kVisibilityBits & 31u));
}

// The same for a pixel that this thread processes.
void pack_own_steps(uint pixel, uint steps) {
  if (!kOwnWords) pack_steps(pixel, steps);
  uint bit = pixel * kVisibilityBits, placed = steps << (bit & 31u);
  bool second = kPixels * kVisibilityBits > 32u && (bit & 32u) != 0u;
  own_words |= uvec2(second ? 0u : placed, second ? placed : 0u);
}

// Stores own_words, after the thread's last pixel.
void keep_own_words(uint lane) {
  if (!kOwnWords) return;
  uint words = kPixels * kVisibilityBits / 32u;
  packed_words[lane * words] = own_words.x;
  if (words > 1u) packed_words[lane * words + 1u] = own_words.y;
}

void start_pixels(uint lane) {
  for (uint i = lane; i < 16u; i += kThreads) packed_words[i] = 0u;
  if (lane == 0u) found = filtered_count = near_count = behind_count = other_count = thin_count = 0u;
}

#endif
