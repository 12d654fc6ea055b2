// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_RADIUS_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_RADIUS_GLSL

#include "shaders/depth_of_field/blur/kernel.glsl"

// Radius of a texel's kernel. Include this after the uniform `dof` and reach_image.

// In texels. own_alpha: of the layer. The far layer's is the texel's own; the near layer's is the greatest that reaches
// the tile, interpolated between tiles.
float kernel_radius(ivec2 texel, float own_alpha) {
  if (kNear == 0u) return own_alpha * dof.radius * dof.reach / float(kScale);
  ivec2 tile = texel * int(kScale) / GLOAM_DOF_TILE;
  vec2 at = (vec2(texel) + 0.5) * (float(kScale) / float(GLOAM_DOF_TILE)) / vec2(dof.tiles);
  float reach = textureLod(reach_image, at, 0.0).x;
  return texelFetch(reach_image, tile, 0).x > 0.0 ? reach / float(kScale) : 0.0;
}

#endif
