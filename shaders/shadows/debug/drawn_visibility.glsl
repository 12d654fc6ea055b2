// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_DRAWN_VISIBILITY_GLSL
#define GLOAM_SHADERS_SHADOWS_DRAWN_VISIBILITY_GLSL

// For visualizers: the visibility of a light with which a pixel is shaded. Evaluated from shadow maps, or, with
// GLOAM_FINAL_LISTS_BINDING, read from the tile's final list; fallback tiles from shadow maps. Include it after
// shadows_api.glsl.

#ifdef GLOAM_FINAL_LISTS_BINDING
#include "shaders/shadows/final_lists/entry.glsl"

layout(constant_id = 1) const uint kFallback = 0u;  // 1: there may be fallback tiles
#endif

// light_vector: as for light_visibility(). faces: whether the light gives the surface anything: it faces the light, or
// lets light from behind through (extinction_m > 0, the result is a transmittance). Final lists hold any visibility for
// other surfaces; the result for them is 0.
float drawn_visibility(uvec2 pixel, bool directional, uint light, vec3 light_vector, ShadowReceiver r, bool faces,
                       float extinction_m) {
#ifdef GLOAM_FINAL_LISTS_BINDING
  FinalList list = final_list(pixel);
  float listed = faces ? entry_visibility(entry_of(list, directional, light), slot_pixel(pixel)) : 0.0;
  if (kFallback == 0u || list.complete || !faces) return listed;
#endif
  return light_visibility(directional, light, light_vector, r, extinction_m);
}

#endif
