// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_FINAL_LISTS_API_GLSL
#define GLOAM_SHADERS_SHADOWS_FINAL_LISTS_API_GLSL

#include "shaders/lights/lights_api.glsl"
#include "shaders/shadows/final_lists_shared.h"

// Reads final lists (layout: final_lists_shared.h). Before including this, define GLOAM_FINAL_LISTS_BINDING, the first
// of four bindings: tiles, entries and both visibility buffers of FinalLists (read_final_lists). The
// specialisation constants are FinalLists::constants. Example:
//   FinalList list = final_list(pixel);
//   for (uint i = 0u; i < list.local_count; ++i) {
//     uint entry = final_entries[list.local_first + i];
//     shade(entry_light(entry), entry_visibility(entry, slot_pixel(pixel)));
//   }

layout(constant_id = 19) const uint kVisibilityBits = 8u;     // bits of a visibility: 8 or 4
layout(constant_id = 20) const uint kVisibilityBuffers = 1u;  // visibility buffers that hold slots: 1 or 2

layout(set = 0, binding = GLOAM_FINAL_LISTS_BINDING) uniform usampler2D final_tiles;
layout(set = 0, binding = GLOAM_FINAL_LISTS_BINDING + 1, scalar) readonly buffer FinalEntries { uint final_entries[]; };
layout(set = 0, binding = GLOAM_FINAL_LISTS_BINDING + 2, scalar) readonly buffer Visibilities0 {
  uint visibilities_0[];
};
layout(set = 0, binding = GLOAM_FINAL_LISTS_BINDING + 3, scalar) readonly buffer Visibilities1 {
  uint visibilities_1[];
};

struct FinalList {
  uint directional_first;
  uint directional_count;
  uint local_first;
  uint local_count;
  bool complete;  // false: fallback tile without entries, shaded from shadow maps
};

FinalList final_list(uvec2 pixel) {
  uvec3 texel = texelFetch(final_tiles, ivec2(pixel / uint(GLOAM_SHADOW_TILE)), 0).xyz;
  return FinalList(texel.x, texel.z >> 16, texel.y, texel.z & 0xFFFFu, texel.y != GLOAM_NO_FINAL_LIST);
}

uint entry_light(uint entry) { return entry & 1023u; }
uint entry_slot(uint entry) { return entry >> 10; }

// Index of a pixel in its tile's slots: 0 … 63, row by row.
uint slot_pixel(uvec2 pixel) { return (pixel.y & 7u) << 3 | (pixel.x & 7u); }

uint slot_words() { return 2u * kVisibilityBits; }

// Visibility 0 … 1 of a pixel (slot_pixel) of the entry's tile.
float entry_visibility(uint entry, uint pixel) {
  uint slot = entry_slot(entry);
  bool stored = slot < GLOAM_NO_ROOM;
  const uint per_buffer = GLOAM_BUFFER_WORDS / slot_words();
  uint at = (stored ? slot % per_buffer : 0u) * slot_words() + (pixel * kVisibilityBits >> 5);
  uint word = visibilities_0[at];
  if (kVisibilityBuffers > 1u && stored && slot >= per_buffer) word = visibilities_1[at];
  uint most = (1u << kVisibilityBits) - 1u;
  float visibility = float(word >> (pixel * kVisibilityBits & 31u) & most) / float(most);
  return stored ? visibility : slot == GLOAM_ALL_LIT ? 1.0 : 0.0;
}

#endif
