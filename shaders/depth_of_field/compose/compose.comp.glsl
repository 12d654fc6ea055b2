// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Lays the blurred layers over the light, in place, in the listed tiles. A pixel behind the focus passes to the far
// layer as its circle grows. The near layer covers all pixels that it has spread to. Pixels in focus that it does not
// reach keep their light to the bit.

layout(local_size_x = GLOAM_DOF_BLOCK, local_size_y_id = 3) in;
layout(constant_id = 0) const uint kScale = 2u;  // pixels a texel of the layers
layout(constant_id = 1) const uint kNear = 0u;   // 1: tiles that the near layer reaches
layout(constant_id = 2) const int kRows = 1;     // rows of layer texels that a thread goes through

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2) uniform sampler2D far_image;
layout(set = 0, binding = 3) uniform sampler2D near_image;
layout(set = 0, binding = 4, rgba16f) uniform image2D lit_image;

#define GLOAM_DOF_LIST_BINDING 5
#include "shaders/depth_of_field/coc_api.glsl"
#include "shaders/depth_of_field/list_api.glsl"

// far: rgb multiplied by alpha, and alpha, the circle. near: premultiplied.
void compose(ivec2 pixel, float depth, vec4 far, vec4 near) {
  if (any(greaterThanEqual(uvec2(pixel), dof.size))) return;
  vec4 light = imageLoad(lit_image, pixel);
  bool counts = is_finite(light.rgb);
  float coc = circle_of_confusion(depth);
  float share = far.a > 0.0 ? layer_share(coc) : 0.0;
  // Light that is not finite does not stay in what is blurred. If there is no other light near, it becomes black.
  if (!counts && coc >= kInFocus) share = 1.0;
  bool replaced = !counts && coc <= -kInFocus;
  vec3 sharp = counts ? light.rgb : vec3(0.0);
  // The far layer is not written where nothing near is behind the focus.
  vec3 composed = share > 0.0 ? mix(sharp, far.rgb / max(far.a, 1e-9), share) : sharp;
  float covered = 0.0;
  if (kNear != 0u) {
    // Half of the kernel lies on the object at its edge. There the layer must cover all, because the light behind the
    // object is unknown.
    covered = min(2.0 * near.a, 1.0);
    composed = composed * (1.0 - covered) + near.rgb * (covered / max(near.a, 1e-6));
  }
  if (share > 0.0 || covered > 0.0 || replaced)
    imageStore(lit_image, pixel, vec4(min(composed, vec3(65504.0)), light.a));
}

vec4 far_texel(ivec2 texel) {
  vec4 far = texelFetch(far_image, clamp(texel, ivec2(0), ivec2(dof.layer_size) - 1), 0);
  return vec4(far.rgb * far.a, far.a);
}
vec4 near_texel(ivec2 texel) { return texelFetch(near_image, clamp(texel, ivec2(0), ivec2(dof.layer_size) - 1), 0); }

// A row of texels, interpolated at the left and the right pixel of the middle one.
struct Pair {
  vec4 left;
  vec4 right;
};
Pair pair_of(vec4 a, vec4 b, vec4 c) { return Pair(mix(b, a, 0.25), mix(b, c, 0.25)); }
Pair far_pair(ivec2 texel) {
  return pair_of(far_texel(texel - ivec2(1, 0)), far_texel(texel), far_texel(texel + ivec2(1, 0)));
}
Pair near_pair(ivec2 texel) {
  if (kNear == 0u) return Pair(vec4(0.0), vec4(0.0));
  return pair_of(near_texel(texel - ivec2(1, 0)), near_texel(texel), near_texel(texel + ivec2(1, 0)));
}

// A column of layer texels, from top to bottom, with 2×2 pixels each. Three rows are kept, so each is fetched once.
void compose_column(ivec2 first) {
  Pair far_above = far_pair(first - ivec2(0, 1)), far_here = far_pair(first);
  Pair near_above = near_pair(first - ivec2(0, 1)), near_here = near_pair(first);
  for (int row = 0; row < kRows; ++row) {
    ivec2 texel = first + ivec2(0, row), pixel = 2 * texel;
    Pair far_below = far_pair(texel + ivec2(0, 1)), near_below = near_pair(texel + ivec2(0, 1));
    vec4 depths = textureGather(depth_image, vec2(pixel + 1) * dof.inverse_size);
    compose(pixel, depths.w, mix(far_here.left, far_above.left, 0.25), mix(near_here.left, near_above.left, 0.25));
    compose(pixel + ivec2(1, 0), depths.z, mix(far_here.right, far_above.right, 0.25),
            mix(near_here.right, near_above.right, 0.25));
    compose(pixel + ivec2(0, 1), depths.x, mix(far_here.left, far_below.left, 0.25),
            mix(near_here.left, near_below.left, 0.25));
    compose(pixel + ivec2(1, 1), depths.y, mix(far_here.right, far_below.right, 0.25),
            mix(near_here.right, near_below.right, 0.25));
    far_above = far_here;
    far_here = far_below;
    near_above = near_here;
    near_here = near_below;
  }
}

void main() {
  DofTile tile;
  if (!listed_tile(kNear != 0u ? uint(GLOAM_DOF_COMPOSE_BOTH) : uint(GLOAM_DOF_COMPOSE_FAR), tile)) return;
  ivec2 local = ivec2(gl_LocalInvocationID.x, int(gl_LocalInvocationID.y) * kRows);
  if (kScale == 2u) {
    compose_column(tile.place * (GLOAM_DOF_TILE / 2) + local);
    return;
  }
  for (int block = 0; block < 4; ++block)
    for (int row = 0; row < kRows; ++row) {
      ivec2 pixel =
          tile.place * GLOAM_DOF_TILE + local + ivec2(block & 1, block >> 1) * GLOAM_DOF_BLOCK + ivec2(0, row);
      vec4 near = vec4(0.0);
      if (kNear != 0u) near = near_texel(pixel);
      compose(pixel, texelFetch(depth_image, min(pixel, ivec2(dof.size) - 1), 0).r, far_texel(pixel), near);
    }
}
