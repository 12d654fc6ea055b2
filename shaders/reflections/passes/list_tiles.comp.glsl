// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/reflections_shared.h"

// Lists tiles by their flags: the passes after this run in the listed tiles only.

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kMirrors = 0u;  // 1: the lists of tiles that hold mirror surfaces; 0: the other list

layout(set = 0, binding = 0, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 1, scalar) readonly buffer Flags { uint tile_flags[]; };
layout(set = 0, binding = 2, scalar) buffer Commands { uint commands[]; };        // MirrorCommands of each list
layout(set = 0, binding = 3, scalar) writeonly buffer Places { uint places[]; };  // of each list: x | y << 16

layout(push_constant, scalar) uniform Push { MirrorLists lists; };

void append(uint list, uint place) {
  uint first = list * lists.command_words;
  uint index = atomicAdd(commands[first + 3u], 1u);
  places[list * lists.place_words + index] = place;
  atomicMax(commands[first + 1u], index / uint(GLOAM_TILE_ROW) + 1u);
}

void main() {
  uint tile = gl_GlobalInvocationID.x;
  if (tile >= lists.tiles) return;
  uint row = (reflection.size.x + GLOAM_REFLECTION_GROUP - 1u) / GLOAM_REFLECTION_GROUP;
  uint place = tile % row | (tile / row) << 16, flags = tile_flags[tile];
  bool mirror = kMirrors != 0u && (flags & GLOAM_TILE_MIRROR) != 0u, bumpy = (flags & GLOAM_TILE_BUMPY) != 0u;
  if (mirror) append(GLOAM_LIST_MIRRORS, place);
  if (mirror && !bumpy) append(GLOAM_LIST_FLAT, place);
  if (mirror && bumpy) append(GLOAM_LIST_BUMPY, place);
  if (kMirrors == 0u && (flags & GLOAM_TILE_STRONG) != 0u) append(GLOAM_LIST_STRONG, place);
}
