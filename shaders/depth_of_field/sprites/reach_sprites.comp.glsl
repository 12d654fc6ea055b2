// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Lists the sprites that reach each tile, one thread a tile.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1, scalar) readonly buffer TileSprites { DofTileSprites tile_sprites[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Sprites { DofSprite sprites[]; };
// Of each tile: their number, then room for GLOAM_DOF_REACHING_SPRITES of them.
layout(set = 0, binding = 3, scalar) writeonly buffer Reaching { uint reaching[]; };
layout(set = 0, binding = 4, scalar) buffer Lists { DofList lists[]; };
layout(set = 0, binding = 5, scalar) readonly buffer PictureBounds { DofPictureBounds picture; };

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, ivec2(dof.tiles)))) return;
  uint room = (uint(tile.y) * dof.tiles.x + uint(tile.x)) * uint(GLOAM_DOF_REACHING_SPRITES + 1);
  uint count = 0u;
  // Lists are read only if the picture has sprites at all.
  int spread = 1 + int((uintBitsToFloat(picture.radius) + 4.0) / float(GLOAM_DOF_TILE));
  int reach = lists[GLOAM_DOF_SPRITES].count > 0u ? spread : -1;
  ivec2 low = max(tile - reach, ivec2(0)), high = min(tile + reach, ivec2(dof.tiles) - 1);
  vec2 corner = vec2(tile * GLOAM_DOF_TILE), end = corner + float(GLOAM_DOF_TILE - 1);
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) {
      uint other = uint(y) * dof.tiles.x + uint(x);
      uint found = tile_sprites[other].count;
      for (uint i = 0u; i < found; ++i) {
        uint id = other * uint(GLOAM_DOF_TILE_SPRITES) + i;
        DofSprite sprite = sprites[id];
        vec2 apart = sprite.place - clamp(sprite.place, corner, end);
        float far = abs(sprite.coc) + 0.4 + 0.6 * sprite.soft;
        bool reached = dot(apart, apart) < far * far;
        if (reached && count < uint(GLOAM_DOF_REACHING_SPRITES)) reaching[room + 1u + count] = id;
        count += reached ? 1u : 0u;
      }
    }
  reaching[room] = min(count, uint(GLOAM_DOF_REACHING_SPRITES));
  if (count > uint(GLOAM_DOF_REACHING_SPRITES)) atomicAdd(lists[GLOAM_DOF_OVERFLOW].count, 1u);
}
