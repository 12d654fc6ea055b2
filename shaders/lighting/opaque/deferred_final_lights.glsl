// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_OPAQUE_DEFERRED_FINAL_LIGHTS_GLSL
#define GLOAM_SHADERS_LIGHTING_OPAQUE_DEFERRED_FINAL_LIGHTS_GLSL

#define GLOAM_FINAL_LISTS_BINDING 9
#include "shaders/lighting/opaque/deferred.glsl"
#include "shaders/shadows/final_lists_api.glsl"

// Deferred lighting with final lists: every pixel loops over the final list of its shadow tile, which holds each
// light's visibility. A fallback tile gets no light here; deferred_fallback draws it.

vec3 directional_lights(ShadingPoint p, uvec2 pixel) {
  FinalList list = final_list(pixel);
  uint at = list.directional_first, end = at + list.directional_count;
  vec3 sum = vec3(0.0);
  for (uint i = 0u; i < kDirectionalLights; ++i) {
    uint entry = final_entries[min(at, max(end, 1u) - 1u)];
    bool has_entry = at < end && entry_light(entry) == i;
    at += uint(has_entry);
    DirectionalLight d = lights.directional[i];
    float share = has_entry ? entry_visibility(entry, slot_pixel(pixel)) : 0.0;
    sum +=
        add_reflected(p, -d.direction, arriving_directional(d.color, i, d.direction, p.normal) * share, d.half_angle);
  }
  return sum;
}

vec3 local_lights(ShadingPoint p, uvec2 pixel) {
  FinalList list = final_list(pixel);
  vec3 sum = vec3(0.0);
  // The loop tests its condition at the end: software devices run the body once more when a test at the start fails.
  uint i = 0u;
  if (list.local_count > 0u) do {
      uint entry = final_entries[list.local_first + i];
      sum += add_local(p, entry_light(entry), entry_visibility(entry, slot_pixel(pixel)));
    } while (++i < list.local_count);
  return sum;
}

#endif
