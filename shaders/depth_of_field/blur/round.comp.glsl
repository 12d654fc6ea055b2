// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// One direction of the round kernel without workgroup memory, in the listed tiles.

layout(local_size_x = GLOAM_DOF_BLOCK, local_size_y = GLOAM_DOF_BLOCK) in;
layout(constant_id = 2) const uint kDirection = 0u;  // kRow or kColumn
layout(constant_id = 3) const uint kList = 0u;       // runs in the tiles of this list

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D reach_image;
layout(set = 0, binding = 2) uniform sampler2D layer_image;
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D blurred_image;

#define GLOAM_DOF_LIST_BINDING 4
#include "shaders/depth_of_field/blur/radius.glsl"
#include "shaders/depth_of_field/list_api.glsl"

void filter_texel(ivec2 texel, int taps) {
  vec4 own = texelFetch(layer_image, inside(texel), 0);
  float radius = kernel_radius(inside(texel), own.a);
  LineSum sum = no_sum();
  add(sum, own, 1.0);
  // Components are chosen one by one: Mesa 22.3 evaluates a choice between constant vectors wrongly.
  ivec2 along = ivec2(kDirection == kRow ? 1 : 0, kDirection == kRow ? 0 : 1);
  for (int n = 1; n <= taps; ++n) {
    float weight = round_weight(n, radius);
    add(sum, texelFetch(layer_image, inside(texel - n * along), 0), weight);
    add(sum, texelFetch(layer_image, inside(texel + n * along), 0), weight);
  }
  if (all(lessThan(uvec2(texel), dof.layer_size))) imageStore(blurred_image, texel, mean(sum, own.a));
}

void main() {
  DofTile tile;
  if (!listed_tile(kList, tile)) return;
  const int side = GLOAM_DOF_TILE / int(kScale);
  ivec2 first = tile.place * side + ivec2(gl_LocalInvocationID.xy);
  for (int y = 0; y < side; y += GLOAM_DOF_BLOCK)
    for (int x = 0; x < side; x += GLOAM_DOF_BLOCK) filter_texel(first + ivec2(x, y), tile.taps);
}
