// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_SHOWN_DIRECTIONAL
#include "shaders/lights/one_light_view_api.glsl"
#include "shaders/shadows/debug/final_list_views.glsl"

// Visualizer light_list with final lists: the result of one light in each tile whose early list holds it. Lit as a
// whole, a visibility slot (as bright as the pixel's visibility), or left out. Pixels that the light reaches although
// their tile's early list does not hold it get a loud colour.

// Whether the tile's early list holds the light. A directional light counts wherever there is a surface.
bool is_early(uvec2 pixel) {
  if (!has_surface(pixel)) return false;
  return shown_directional != 0u || (kEarlyLists != 0u && list_holds(pixel));
}

vec3 state_color(FinalList list, uvec2 pixel) {
  if (!list.complete) return kFallbackColor;
  uint entry = entry_of(list, shown_directional != 0u, shown_light), slot = entry_slot(entry);
  if (slot == GLOAM_ALL_LIT) return vec3(0.75, 0.9, 0.2);
  if (slot == GLOAM_ALL_UNLIT) return kLeftOut;
  return mix(vec3(0.0, 0.05, 0.0), vec3(0.05, 0.8, 0.05), entry_visibility(entry, slot_pixel(pixel)));
}

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  if (is_early(pixel)) {
    show(with_grid(state_color(final_list(pixel), pixel), pixel, GLOAM_SHADOW_TILE), kDarkened);
    return;
  }
  bool lit = shown_directional == 0u && lights_pixel(fetch_light(light_texels, shown_light), pixel);
  show(lit ? kLoud : vec3(0.0), lit ? kLoudOpacity : kDarkened);
}
