// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Makes the layers from the light. Far: the mean light of the texel's pixels behind the focus, each weighted by its
// circle of confusion, and in alpha the mean circle as a share of the greatest radius; 0 where nothing is blurred.
// Near: light of the pixels before the focus, multiplied by their share, which is in alpha. Beyond: all other light, in
// the same way. Light that is not finite counts as absent.

layout(local_size_x = GLOAM_DOF_BLOCK, local_size_y = GLOAM_DOF_BLOCK) in;
layout(constant_id = 0) const uint kScale = 2u;  // pixels a texel
layout(constant_id = 1) const uint kNear = 0u;   // 1: the layers near and beyond, too

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2) uniform sampler2D lit_image;
layout(set = 0, binding = 3, rgba16f) uniform writeonly image2D far_image;
layout(set = 0, binding = 4, rgba16f) uniform writeonly image2D near_image;
layout(set = 0, binding = 5, rgba16f) uniform writeonly image2D beyond_image;

#define GLOAM_DOF_LIST_BINDING 6
#include "shaders/depth_of_field/coc_api.glsl"
#include "shaders/depth_of_field/list_api.glsl"

vec3 far_light;
vec4 near, beyond;
float far_weight, far_squares;

void add(ivec2 pixel, float depth, float share) {
  vec3 light = texelFetch(lit_image, min(pixel, ivec2(dof.size) - 1), 0).rgb;
  bool counts = is_finite(light);
  float coc = circle_of_confusion(depth);
  light = counts ? light : vec3(0.0);
  float weight = counts && coc >= kInFocus ? coc : 0.0;
  far_light += weight * light;
  far_weight += weight;
  far_squares += weight * weight;
  if (kNear != 0u) {
    float counted = counts ? share : 0.0, covered = layer_share(-coc);
    near += counted * covered * vec4(light, 1.0);
    beyond += counted * (1.0 - covered) * vec4(light, 1.0);
  }
}

void filter_texel(ivec2 texel) {
  far_light = vec3(0.0);
  near = beyond = vec4(0.0);
  far_weight = far_squares = 0.0;
  if (kScale == 2u) {
    ivec2 corner = 2 * texel;
    vec4 depths = textureGather(depth_image, vec2(corner + 1) * dof.inverse_size);
    add(corner, depths.w, 0.25);
    add(corner + ivec2(1, 0), depths.z, 0.25);
    add(corner + ivec2(0, 1), depths.x, 0.25);
    add(corner + ivec2(1, 1), depths.y, 0.25);
  } else {
    add(texel, texelFetch(depth_image, min(texel, ivec2(dof.size) - 1), 0).r, 1.0);
  }
  if (any(greaterThanEqual(uvec2(texel), dof.layer_size))) return;
  float scale = far_weight > 0.0 ? 1.0 / far_weight : 0.0;
  vec4 far = vec4(far_light * scale, far_squares * scale / dof.radius);
  imageStore(far_image, texel, min(far, vec4(65504.0)));
  if (kNear == 0u) return;
  imageStore(near_image, texel, min(near, vec4(65504.0)));
  imageStore(beyond_image, texel, min(beyond, vec4(65504.0)));
}

void main() {
  DofTile tile;
  if (!listed_tile(kNear != 0u ? uint(GLOAM_DOF_PREFILTER_BOTH) : uint(GLOAM_DOF_PREFILTER_FAR), tile)) return;
  const int side = GLOAM_DOF_TILE / int(kScale);
  ivec2 first = tile.place * side + ivec2(gl_LocalInvocationID.xy);
  for (int y = 0; y < side; y += GLOAM_DOF_BLOCK)
    for (int x = 0; x < side; x += GLOAM_DOF_BLOCK) filter_texel(first + ivec2(x, y));
}
