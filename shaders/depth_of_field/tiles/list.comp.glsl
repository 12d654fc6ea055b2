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
layout(set = 0, binding = 4, scalar) readonly buffer TileSprites { DofTileSprites tile_sprites[]; };
layout(set = 0, binding = 5, scalar) readonly buffer Reaching { uint reaching[]; };
layout(set = 0, binding = 6, scalar) buffer Lists { DofList lists[]; };
// Of each list, room for all tiles.
layout(set = 0, binding = 7, scalar) writeonly buffer Entries { DofEntry entries[]; };

#include "shaders/depth_of_field/tiles/spread.glsl"

// tiles: of a workgroup.
void append(uint list, int tiles, DofEntry entry) {
  uint index = atomicAdd(lists[list].count, 1u), group = index / uint(tiles);
  atomicMax(lists[list].groups_x, min(group + 1u, uint(GLOAM_DOF_ROW)));
  atomicMax(lists[list].groups_y, group / uint(GLOAM_DOF_ROW) + 1u);
  entries[list * dof.tiles.x * dof.tiles.y + index] = entry;
}

uint composed_kind(DofTileReach reach, bool sprites) {
  const uint fine = 3u;
  if (sprites) return uint(GLOAM_DOF_COMPOSE_SPRITES);
  if (reach.near == 0u) {
    int finest = findLSB(reach.far), count = bitCount(reach.far);
    if (count == 1 && finest > 0) return uint(GLOAM_DOF_COMPOSE_ONE + finest);
    bool two = count == 2 && finest > 1 && (reach.far >> finest & 2u) != 0u;
    return two ? uint(GLOAM_DOF_COMPOSE_TWO + finest) : uint(GLOAM_DOF_COMPOSE_FAR);
  }
  if (reach.far != 0u) return uint(GLOAM_DOF_COMPOSE_BOTH);
  return (reach.near & ~fine) == 0u ? uint(GLOAM_DOF_COMPOSE_NEAR_FINE) : uint(GLOAM_DOF_COMPOSE_NEAR);
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
  bool sprites = tile_sprites[index].surroundings >= 0.0;
  for (int k = dof.first_level; k <= dof.last_level; ++k) {
    uint bit = 1u << k;
    uint wanted = ((far_layer & bit) != 0u ? uint(GLOAM_DOF_WANTS_FAR) : 0u) |
                  ((near_layer & bit) != 0u ? uint(GLOAM_DOF_WANTS_NEAR) : 0u) |
                  ((near_layer & own.near & bit) != 0u ? uint(GLOAM_DOF_HAS_NEAR) : 0u);
    bool more = sprites || own.near_radius > 0.0;
    uint prefilter = uint(k + (more ? GLOAM_DOF_PREFILTER_MORE : GLOAM_DOF_PREFILTER));
    if (wanted != 0u) append(prefilter, dof.prefilter_tiles[k], DofEntry(place, int(wanted)));
    float greatest = k == dof.last_level ? dof.radius : dof.to[k];
    int far_work = own.far_radius > 0.0 ? texels_of(kernel_radius(min(own.far_radius, greatest), k)) : 0;
    if (own.near_radius > 0.0)
      far_work += GLOAM_DOF_FILLS * texels_of(kernel_radius(min(own.near_radius, greatest), k));
    float near_greatest = k == dof.last_level ? dof.radius : GLOAM_DOF_NEAR_FINER * dof.to[k];
    int near_work = texels_of(kernel_radius(min(own_reach.near_radius, near_greatest), k));
    // Beyond the tiles that are composed there is nothing to interpolate with.
    if (((far | own_reach.far) & bit) != 0u)
      append(uint(GLOAM_DOF_FAR + k), dof.gather_tiles[k],
             DofEntry(place, (own_reach.far & bit) != 0u ? far_work : GLOAM_DOF_EMPTY));
    if (((near | own_reach.near) & bit) != 0u)
      append(uint(GLOAM_DOF_NEAR + k), dof.gather_tiles[k],
             DofEntry(place, (own_reach.near & bit) != 0u ? near_work : GLOAM_DOF_EMPTY));
  }
  bool reached_by_sprites = reaching[index * uint(GLOAM_DOF_REACHING_SPRITES + 1)] > 0u;
  if ((own_reach.near | own_reach.far) != 0u)
    append(uint(GLOAM_DOF_COMPOSE) + composed_kind(own_reach, sprites || reached_by_sprites), 1, DofEntry(place, 0));
  if (own_reach.near != 0u) atomicAdd(lists[GLOAM_DOF_NEAR_TILES].count, 1u);
  if (max(own.far_radius, own.near_radius) > dof.limit) atomicAdd(lists[GLOAM_DOF_COARSER].count, 1u);
}
