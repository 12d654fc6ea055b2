// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_LIST_API_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_LIST_API_GLSL

#include "shaders/depth_of_field/depth_of_field_shared.h"

// For passes over the tiles of one list. Define GLOAM_DOF_LIST_BINDING as the first of two
// bindings, and include this after the uniform `dof`.

layout(set = 0, binding = GLOAM_DOF_LIST_BINDING, scalar) readonly buffer Lists { DofList lists[]; };
layout(set = 0, binding = GLOAM_DOF_LIST_BINDING + 1, scalar) readonly buffer Entries { DofEntry entries[]; };

struct DofTile {
  ivec2 place;
  int work;  // DofEntry
};

uint list_group() { return gl_WorkGroupID.y * uint(GLOAM_DOF_ROW) + gl_WorkGroupID.x; }

// A tile of a list. False: there is none of this index.
bool listed_tile(uint list, uint index, out DofTile tile) {
  uint count = lists[list].count;
  DofEntry entry = entries[list * dof.tiles.x * dof.tiles.y + min(index, max(count, 1u) - 1u)];
  tile = DofTile(ivec2(entry.place & 0xFFFFu, entry.place >> 16), entry.work);
  return index < count;
}

#endif
