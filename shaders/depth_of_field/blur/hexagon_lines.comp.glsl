// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// The first pass of the hexagonal kernel without workgroup memory, in the listed tiles: the upright line, and the mean
// of it and the line to the right.

layout(local_size_x = GLOAM_DOF_BLOCK, local_size_y = GLOAM_DOF_BLOCK) in;

layout(constant_id = 3) const uint kList = 0u;  // runs in the tiles of this list

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D reach_image;
layout(set = 0, binding = 2) uniform sampler2D layer_image;
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D upright_image;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D both_image;

#define GLOAM_DOF_LIST_BINDING 5
#include "shaders/depth_of_field/blur/radius.glsl"
#include "shaders/depth_of_field/list_api.glsl"

void filter_texel(ivec2 texel, int taps) {
  vec4 own = texelFetch(layer_image, inside(texel), 0);
  float radius = kernel_radius(inside(texel), own.a);
  LineSum up = no_sum(), right = no_sum();
  add(up, own, line_weight(0, radius));
  add_row_trio(right, layer_image, texel, line_weight(0, kSlanted * radius));
  for (int n = 1; n <= taps; n += 2) {
    add(up, texelFetch(layer_image, inside(texel - ivec2(0, n)), 0), line_weight(n, radius));
    add(up, texelFetch(layer_image, inside(texel - ivec2(0, n + 1)), 0), line_weight(n + 1, radius));
    add_slanted(right, layer_image, texel, 1, n, kSlanted * radius);
  }
  if (any(greaterThanEqual(uvec2(texel), dof.layer_size))) return;
  vec4 upright = mean(up, own.a);
  imageStore(upright_image, texel, upright);
  imageStore(both_image, texel, mix(mean(right, own.a), upright, kUpShare));
}

void main() {
  DofTile tile;
  if (!listed_tile(kList, tile)) return;
  const int side = GLOAM_DOF_TILE / int(kScale);
  ivec2 first = tile.place * side + ivec2(gl_LocalInvocationID.xy);
  for (int y = 0; y < side; y += GLOAM_DOF_BLOCK)
    for (int x = 0; x < side; x += GLOAM_DOF_BLOCK) filter_texel(first + ivec2(x, y), tile.taps);
}
