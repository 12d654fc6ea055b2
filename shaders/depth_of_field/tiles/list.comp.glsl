// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"
#include "shaders/depth_of_field/kernel_api.glsl"

// Lists the tiles in which each pass runs. A pass whose result is read in neighbouring texels also runs in the tiles
// that those texels can lie in, so no pass reads a texel that was not written.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1, scalar) readonly buffer Bounds { DofTileBounds bounds[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Reach { DofTileReach reached[]; };
layout(set = 0, binding = 3, scalar) readonly buffer PictureBounds { DofPictureBounds picture; };
layout(set = 0, binding = 4, scalar) buffer Lists { DofList lists[]; };
// Of each list, room for all tiles and levels.
layout(set = 0, binding = 5, scalar) writeonly buffer Entries { DofEntry entries[]; };

#include "shaders/depth_of_field/tiles/spread.glsl"

void append(uint list, DofEntry entry) {
  uint index = atomicAdd(lists[list].count, 1u);
  atomicMax(lists[list].groups_x, min(index + 1u, uint(GLOAM_DOF_ROW)));
  atomicMax(lists[list].groups_y, index / uint(GLOAM_DOF_ROW) + 1u);
  entries[list * dof.tiles.x * dof.tiles.y * uint(GLOAM_DOF_LEVELS) + index] = entry;
}

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, ivec2(dof.tiles)))) return;
  // Levels of this tile's texels that are read: by kernels (layer), between texels (far, near).
  uint far_layer = 0u, near_layer = 0u, far = 0u, near = 0u;
  int reach = max(find_spreads(), (picture.far_levels | picture.near_levels) != 0u ? 1 : 0);
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      ivec2 other = clamp(tile + ivec2(x, y), ivec2(0), ivec2(dof.tiles) - 1);
      DofTileReach found = reached[other.y * int(dof.tiles.x) + other.x];
      int apart = max(abs(x), abs(y));
      uint read = levels_read(apart);
      far_layer |= found.far & read;
      near_layer |= found.near & read;
      // Texels of level 0 are pixels: nothing lies between them.
      uint between = apart == 1 ? 0xFEu : 0u;
      far |= found.far & between;
      near |= found.near & between;
    }
  uint index = uint(tile.y) * dof.tiles.x + uint(tile.x);
  DofTileBounds own = bounds[index];
  DofTileReach own_reach = reached[index];
  uint place = uint(tile.x) | uint(tile.y) << 16;
  for (int k = dof.first_level; k <= dof.last_level; ++k) {
    uint bit = 1u << k;
    uint wanted = ((far_layer & bit) != 0u ? uint(GLOAM_DOF_WANTS_FAR) : 0u) |
                  ((near_layer & bit) != 0u ? uint(GLOAM_DOF_WANTS_NEAR) : 0u) |
                  ((near_layer & own.near & bit) != 0u ? uint(GLOAM_DOF_HAS_NEAR) : 0u);
    if (wanted != 0u)
      append(k == 0 ? uint(GLOAM_DOF_PREFILTER_FINE) : uint(GLOAM_DOF_PREFILTER_COARSE),
             DofEntry(place, k, int(wanted)));
    float greatest = k == dof.last_level ? dof.radius : dof.to[k];
    bool fills = own.near_radius > 0.0;
    int far_work = texels_of(kernel_radius(min(max(own.far_radius, own.near_radius), greatest), k)) |
                   (fills ? GLOAM_DOF_FILLS : 0);
    float near_greatest = k == dof.last_level ? dof.radius : GLOAM_DOF_NEAR_FINER * dof.to[k];
    int near_work = texels_of(kernel_radius(min(own_reach.near_radius, near_greatest), k));
    // Beyond the tiles that are composed there is nothing to interpolate with.
    if (((far | own_reach.far) & bit) != 0u)
      append(uint(GLOAM_DOF_FAR), DofEntry(place, k, (own_reach.far & bit) != 0u ? far_work : GLOAM_DOF_EMPTY));
    if (((near | own_reach.near) & bit) != 0u)
      append(uint(GLOAM_DOF_NEAR), DofEntry(place, k, (own_reach.near & bit) != 0u ? near_work : GLOAM_DOF_EMPTY));
  }
  if (own_reach.near != 0u)
    append(uint(GLOAM_DOF_COMPOSE_BOTH), DofEntry(place, 0, 0));
  else if (own_reach.far != 0u)
    append(uint(GLOAM_DOF_COMPOSE_FAR), DofEntry(place, 0, 0));
  if (max(own.far_radius, own.near_radius) > dof.limit) atomicAdd(lists[GLOAM_DOF_COARSER].count, 1u);
}
