// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"
#include "shaders/depth_of_field/kernel_api.glsl"

// The levels of both layers that are composed in each tile.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1, scalar) readonly buffer Bounds { DofTileBounds bounds[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Reach { DofTileReach reached[]; };
layout(set = 0, binding = 3, scalar) readonly buffer PictureBounds { DofPictureBounds picture; };

#include "shaders/depth_of_field/tiles/spread.glsl"

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, ivec2(dof.tiles)))) return;
  uint near = 0u, open = 0u;  // open: levels whose kernels find light behind the tile's objects
  float near_radius = 0.0;
  DofTileBounds own = bounds[tile.y * int(dof.tiles.x) + tile.x];
  int reach = max(near_spread(), find_spreads());
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      ivec2 other = clamp(tile + ivec2(x, y), ivec2(0), ivec2(dof.tiles) - 1);
      DofTileBounds found = bounds[other.y * int(dof.tiles.x) + other.x];
      int apart = max(abs(x), abs(y));
      uint reaching = 0u;
      for (int k = dof.first_level; k <= dof.last_level; ++k) {
        float greatest =
            k == dof.last_level ? found.near_radius : min(found.near_radius, GLOAM_DOF_NEAR_FINER * dof.to[k]);
        reaching |= reaches(greatest, k, apart) ? 1u << k : 0u;
      }
      near |= found.near & reaching;
      near_radius = max(near_radius, (found.near & reaching) != 0u ? found.near_radius : 0.0);
      // As lies_behind(): light of a half float's rounding less is found as well.
      open |= found.least_near < max(0.81 * own.near_radius - 0.25, 1e-3) ? levels_read(apart) : 0u;
    }
  // Behind the tile's own objects before the focus, the far layer is filled in from what is visible near them.
  uint far = own.far | (open & own.fill);
  reached[tile.y * int(dof.tiles.x) + tile.x] = DofTileReach(far, near, near_radius);
}
