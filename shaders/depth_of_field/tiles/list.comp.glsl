// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Lists the tiles in which each pass runs. A pass whose result is read in neighbouring texels also runs in the tiles
// that those texels can lie in, so no pass reads a texel that was not written.

layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 0) const uint kScale = 2u;  // pixels a texel of a layer
layout(constant_id = 1) const uint kRound = 0u;  // 1: the last pass reads texels of the first along columns only

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D reach_image;
layout(set = 0, binding = 2, scalar) buffer Lists { DofList lists[]; };
// Of each list, room for all tiles: x, y << 12, and the farthest texel that a kernel reads << 24.
layout(set = 0, binding = 3, scalar) buffer Entries { uint entries[]; };
// Of each tile: bit n for list n < 8, then the farthest texel of the far layer << 8 and of the near layer << 16.
layout(set = 0, binding = 4, scalar) buffer Flags { uint tile_flags[]; };

void append(uint list, uint place, uint taps) {
  uint index = atomicAdd(lists[list].count, 1u);
  atomicMax(lists[list].groups_x, min(index + 1u, uint(GLOAM_DOF_ROW)));
  atomicMax(lists[list].groups_y, index / uint(GLOAM_DOF_ROW) + 1u);
  entries[list * dof.tiles.x * dof.tiles.y + index] = place | taps << 24;
}

// The farthest texel that has a weight in a kernel of this radius in pixels (kernel.glsl). The radius is a little
// greater than stored ones after rounding.
uint taps_of(float radius) { return radius > 0.0 ? uint(ceil(radius * 1.001 / float(kScale) + 0.5)) - 1u : 0u; }

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, ivec2(dof.tiles)))) return;
  int here = dof.spread + 1;  // y of reach_image where the tile itself is blurred
  float widest = 0.0;         // radius before the focus, over the tile and its neighbours
  // As y of reach_image: something before the focus reaches the tile; the same is shown in the tile, near
  // something else.
  int near = 0, shown = 0;
  int near_first = 0, shown_first = 0;  // of the tiles whose last pass reads this one
  for (int y = -GLOAM_DOF_MOST_SPREAD; y <= GLOAM_DOF_MOST_SPREAD; ++y)
    for (int x = -GLOAM_DOF_MOST_SPREAD; x <= GLOAM_DOF_MOST_SPREAD; ++x) {
      vec4 reach = texelFetch(reach_image, clamp(tile + ivec2(x, y), ivec2(0), ivec2(dof.tiles) - 1), 0);
      float radius = reach.x;
      int apart = max(abs(x), abs(y));
      int near_from = radius > 0.0 ? here - apart : 0, shown_from = reach.w > 0.0 ? here - apart : 0;
      near = max(near, near_from);
      shown = max(shown, shown_from);
      bool is_read = kRound == 0u || x == 0;
      near_first = max(near_first, is_read ? near_from : 0);
      shown_first = max(shown_first, is_read ? shown_from : 0);
      widest = max(widest, apart <= 1 ? radius : 0.0);
    }
  vec4 reach = texelFetch(reach_image, tile, 0);
  int far = int(reach.y);
  uint far_taps = taps_of(reach.z), near_taps = near == here ? taps_of(widest) : 0u;
  uint place = uint(tile.x) | uint(tile.y) << 12;
  uint flags = far_taps << 8 | near_taps << 16;
  bool wanted[GLOAM_DOF_LISTS] =
      bool[](far >= 1 && near == 0, near >= 1, far >= 1, near_first >= 1 || near >= here - 1, far >= here - 1,
             near >= here - 1, far == here && near < here, near == here, shown_first >= 1, shown == here);
  for (uint list = 0u; list < uint(GLOAM_DOF_LISTS); ++list) {
    bool is_near = (list & 1u) != 0u || list >= uint(GLOAM_DOF_BEYOND_FIRST);
    if (wanted[list]) {
      append(list, place, is_near ? near_taps : far_taps);
      if (list < 8u) flags |= 1u << list;
    }
  }
  tile_flags[uint(tile.y) * dof.tiles.x + uint(tile.x)] = flags;
}
