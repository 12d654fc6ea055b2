// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// The greatest radii of kernels of each tile, before and behind the focus, one thread a tile. They follow from the
// nearest and the farthest depth, because the circle grows with depth.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2,
       rg32f) uniform writeonly image2D tile_image;  // greatest radius: near, far; far −1: the near layer holds all
layout(set = 0, binding = 3, scalar) buffer Lists { DofList lists[]; };  // emptied

#include "shaders/depth_of_field/coc_api.glsl"

float least(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }
float greatest(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }

void main() {
  uvec2 tile = gl_GlobalInvocationID.xy;
  if (tile.y == 0u && tile.x < uint(GLOAM_DOF_LISTS)) lists[tile.x] = DofList(0u, 1u, 1u, 0u);
  if (any(greaterThanEqual(tile, dof.tiles))) return;
  vec2 corner = vec2(tile * uint(GLOAM_DOF_TILE) + 1u);
  float near = 0.0, far = 1e9;  // depths; reversed Z
  for (int y = 0; y < GLOAM_DOF_TILE; y += 2)
    for (int x = 0; x < GLOAM_DOF_TILE; x += 2) {
      vec4 depths = textureGather(depth_image, (corner + vec2(x, y)) * dof.inverse_size);
      near = max(near, greatest(depths));
      far = min(far, least(depths));
    }
  bool solid = layer_share(-circle_of_confusion(far)) >= 1.0;
  float before = max(-circle_of_confusion(near), 0.0), behind = max(circle_of_confusion(far), 0.0);
  imageStore(tile_image, ivec2(tile),
             vec4(before < kInFocus ? 0.0 : before * dof.reach,
                  solid               ? -1.0
                  : behind < kInFocus ? 0.0
                                      : behind * dof.reach,
                  0.0, 0.0));
}
