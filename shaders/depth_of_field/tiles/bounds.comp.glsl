// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// The circles of each tile, one thread a tile.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2, scalar) writeonly buffer Bounds { DofTileBounds bounds[]; };
layout(set = 0, binding = 3, scalar) buffer PictureBounds { DofPictureBounds picture; };

#include "shaders/depth_of_field/coc_api.glsl"

bool has_any(bvec4 v) { return any(v); }

void main() {
  uvec2 tile = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(tile, dof.tiles))) return;
  vec2 corner = vec2(tile * uint(GLOAM_DOF_TILE) + 1u);
  uint far = 0u, near = 0u, fill = 0u;
  float far_radius = 0.0, near_radius = 0.0, least_near = 1e9;
  // Level k has circles from low to high.
  float low[GLOAM_DOF_LEVELS], high[GLOAM_DOF_LEVELS];
  for (int k = 0; k < GLOAM_DOF_LEVELS; ++k) {
    low[k] = k == dof.first_level ? kInFocus : dof.from[max(k - 1, 0)];
    high[k] = k == dof.last_level ? 1e9 : dof.to[k];
  }
  for (int y = 0; y < GLOAM_DOF_TILE; y += 2)
    for (int x = 0; x < GLOAM_DOF_TILE; x += 2) {
      vec4 depths = textureGather(depth_image, (corner + vec2(x, y)) * dof.inverse_size);
      vec4 coc = clamp(dof.coc_offset + dof.coc_slope * depths, -dof.radius, dof.radius);
      vec2 least2 = min(coc.xy, coc.zw), most2 = max(coc.xy, coc.zw);
      float least = min(least2.x, least2.y), most = max(most2.x, most2.y);
      far_radius = max(far_radius, most);
      near_radius = max(near_radius, -least);
      least_near = min(least_near, -most);
      for (int k = 0; k < GLOAM_DOF_LEVELS; ++k) {
        bool behind = has_any(bvec4(uvec4(greaterThanEqual(coc, vec4(low[k]))) & uvec4(lessThan(coc, vec4(high[k])))));
        float near_low = k == dof.first_level ? low[k] : GLOAM_DOF_NEAR_FINER * low[k];
        bool before = has_any(bvec4(uvec4(lessThanEqual(coc, vec4(-near_low))) &
                                    uvec4(greaterThan(coc, vec4(-GLOAM_DOF_NEAR_FINER * high[k])))));
        bool hidden =
            has_any(bvec4(uvec4(lessThanEqual(coc, vec4(-low[k]))) & uvec4(greaterThan(coc, vec4(-high[k])))));
        far |= behind ? 1u << k : 0u;
        fill |= hidden ? 1u << k : 0u;
        near |= before ? 1u << k : 0u;
      }
    }
  uint levels = (2u << dof.last_level) - (1u << dof.first_level);
  far_radius = far_radius < kInFocus ? 0.0 : far_radius;
  near_radius = near_radius < kInFocus ? 0.0 : near_radius;
  least_near = least_near < kInFocus ? 0.0 : least_near;
  bounds[tile.y * dof.tiles.x + tile.x] =
      DofTileBounds(far & levels, near & levels, fill & levels, least_near, far_radius, near_radius);
  if (((far | fill) & levels) != 0u) atomicOr(picture.far_levels, (far | fill) & levels);
  if ((near & levels) != 0u) atomicOr(picture.near_levels, near & levels);
  if (near_radius > 0.0) atomicMax(picture.near_radius, floatBitsToUint(near_radius));
  if (max(near_radius, far_radius) > 0.0) atomicMax(picture.radius, floatBitsToUint(max(near_radius, far_radius)));
}
