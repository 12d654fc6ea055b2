// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#define GLOAM_EARLY_LISTS_BINDING 6
#include "shaders/common/heat.glsl"
#include "shaders/lights/light_lists_api.glsl"
#include "shaders/lights/light_views_api.glsl"
#include "shaders/shadows/debug/final_list_views.glsl"

// Visualizers lights_final and visibility_slots: how many lights, or how many visibility slots, each tile's final list
// holds; without slots, why there are none.

layout(constant_id = 2) const uint kSlots = 0u;  // 1: slots

layout(push_constant, scalar) uniform Push { uint directional_count; };
layout(set = 0, binding = 5) uniform usampler2D tile_lists;

const float kMostSlots = 10.0;  // most slots that colours distinguish
const float kNoList = -1.0;     // the number of a tile without a final list

// Number of entries of a run with a visibility slot.
uint slots_of(uint first, uint count) {
  uint slots = 0u;
  for (uint i = 0u; i < count; ++i) slots += uint(entry_slot(final_entries[first + i]) < GLOAM_NO_ROOM);
  return slots;
}

// Number of lights in the tile's early list, directional lights included.
uint early_count(uvec2 pixel) {
  if (!has_surface(pixel)) return 0u;
  return directional_count +
         (kEarlyLists != 0u ? list_count(texelFetch(tile_lists, ivec2(pixel / uint(GLOAM_SHADOW_TILE)), 0).xy) : 0u);
}

void show_slots(uvec2 pixel, FinalList list) {
  uint slots = slots_of(list.directional_first, list.directional_count) + slots_of(list.local_first, list.local_count);
  if (slots > 0u) {
    show_number(with_grid(heat(float(slots) / kMostSlots), pixel, GLOAM_SHADOW_TILE), kDarkened, float(slots));
  } else if (early_count(pixel) == 0u) {
    show_number(vec3(0.0), 1.0, 0.0);
  } else {
    bool lit = list.directional_count + list.local_count > 0u;
    show_number(lit ? vec3(0.0) : with_grid(0.25 * kLeftOut, pixel, GLOAM_SHADOW_TILE), kDarkened, 0.0);
  }
}

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  FinalList list = final_list(pixel);
  if (!list.complete) {
    show_number(with_grid(kFallbackColor, pixel, GLOAM_SHADOW_TILE), kSlots != 0u ? kLoudOpacity : 1.0, kNoList);
  } else if (kSlots != 0u) {
    show_slots(pixel, list);
  } else {
    float lights = float(list.directional_count + list.local_count);
    show_number(with_grid(heat(lights / 31.0), pixel, GLOAM_SHADOW_TILE), 1.0, lights);
  }
}
