// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Writes the blur that can reach each tile: the greatest kernel before the focus of all tiles that it may spread from,
// and the distance to the nearest tile with circles behind the focus.

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D tile_image;
// x: radius that reaches the tile from before the focus; y: something is blurred behind the focus in the tile (spread +
// 1), in a neighbour (spread), … spread tiles away (1), nowhere near (0); z: greatest radius behind the focus in the
// tile; w: greatest radius before the focus in the tile,
// 0 if kernels reach nothing but the near layer.
layout(set = 0, binding = 2, rgba16f) uniform writeonly image2D reach_image;

void main() {
  ivec2 tile = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(tile, ivec2(dof.tiles)))) return;
  float near = 0.0, far = 0.0;
  bool open = false;  // a kernel may reach light that is not in the near layer
  for (int y = -GLOAM_DOF_MOST_SPREAD; y <= GLOAM_DOF_MOST_SPREAD; ++y)
    for (int x = -GLOAM_DOF_MOST_SPREAD; x <= GLOAM_DOF_MOST_SPREAD; ++x) {
      ivec2 other = tile + ivec2(x, y);
      vec2 radius = texelFetch(tile_image, clamp(other, ivec2(0), ivec2(dof.tiles) - 1), 0).xy;
      int apart = max(abs(x), abs(y));
      // Pixels of tiles that touch are 1 pixel apart, of others a whole tile more.
      bool reaches = radius.x > float(max(apart - 1, 0) * GLOAM_DOF_TILE);
      near = max(near, reaches ? radius.x : 0.0);
      open = open || (apart <= dof.spread && radius.y >= 0.0);
      far = max(far, radius.y > 0.0 ? float(dof.spread + 1 - apart) : 0.0);
    }
  vec2 own = texelFetch(tile_image, tile, 0).xy;
  imageStore(reach_image, tile, vec4(near, far, max(own.y, 0.0), open ? own.x : 0.0));
}
