// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_FINAL_ENTRY_GLSL
#define GLOAM_SHADERS_SHADOWS_FINAL_ENTRY_GLSL

#include "shaders/shadows/final_lists_api.glsl"

// A light's entry in a tile's final list, with slot GLOAM_ALL_UNLIT when it has none. Shaders that iterate over lists
// do not need this.
uint entry_of(FinalList list, bool directional, uint light) {
  uint first = directional ? list.directional_first : list.local_first;
  uint count = directional ? list.directional_count : list.local_count;
  uint found = light | GLOAM_ALL_UNLIT << 10;
  for (uint i = 0u; i < count; ++i)
    if (entry_light(final_entries[first + i]) == light) found = final_entries[first + i];
  return found;
}

#endif
