// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Lays the blurred layers over the light, in place, in the listed tiles. A pixel behind the focus passes to the far
// layer as its circle grows. The near layer covers the pixels that it has spread to by its alpha. What is behind it is
// the pixel's own light, or the layer beyond where the pixel shows an object before the focus. Pixels in focus that the
// near layer does not reach keep their light to the bit.

layout(local_size_x = GLOAM_DOF_BLOCK, local_size_y_id = 3) in;
layout(constant_id = 0) const uint kScale = 2u;  // pixels a texel of the layers
layout(constant_id = 1) const uint kNear = 0u;   // 1: tiles that the near layer reaches
layout(constant_id = 2) const int kRows = 1;     // rows of layer texels that a thread goes through

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D depth_image;
layout(set = 0, binding = 2) uniform sampler2D far_image;
layout(set = 0, binding = 3) uniform sampler2D near_image;
layout(set = 0, binding = 4) uniform sampler2D beyond_image;
layout(set = 0, binding = 5) uniform sampler2D reach_image;
layout(set = 0, binding = 6, rgba16f) uniform image2D lit_image;

#define GLOAM_DOF_LIST_BINDING 7
#include "shaders/depth_of_field/coc_api.glsl"
#include "shaders/depth_of_field/list_api.glsl"

// Of the layers before the focus, at a texel or a pixel; both premultiplied.
struct Near {
  vec4 near;
  vec4 beyond;
};
Near mix_near(Near a, Near b, float share) { return Near(mix(a.near, b.near, share), mix(a.beyond, b.beyond, share)); }

bool beyond_is_written;  // in the tile

// far: rgb multiplied by alpha, and alpha, the circle.
void compose(ivec2 pixel, float depth, vec4 far, Near before) {
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
    // The light beyond is written only where something before the focus is shown.
    float hidden = layer_share(-coc);
    covered = min(before.near.a, 1.0);
    // Where nothing beyond is near, light that is missing was not finite. The object's own takes its place.
    vec4 behind = beyond_is_written && before.beyond.a > 1e-4 ? before.beyond : before.near;
    if (hidden > 0.0) composed = mix(composed, behind.rgb / max(behind.a, 1e-6), hidden);
    if (covered > 0.0) composed = before.near.rgb + (1.0 - covered) * composed;
  }
  if (share > 0.0 || covered > 0.0 || replaced)
    imageStore(lit_image, pixel, vec4(min(composed, vec3(65504.0)), light.a));
}

vec4 far_texel(ivec2 texel) {
  vec4 far = texelFetch(far_image, clamp(texel, ivec2(0), ivec2(dof.layer_size) - 1), 0);
  return vec4(far.rgb * far.a, far.a);
}
ivec2 tile_corner;  // its first texel. The light beyond is not written in neighbours.
Near near_texel(ivec2 texel) {
  ivec2 at = clamp(texel, ivec2(0), ivec2(dof.layer_size) - 1);
  ivec2 in_tile = clamp(at, tile_corner, tile_corner + GLOAM_DOF_TILE / int(kScale) - 1);
  return Near(texelFetch(near_image, at, 0), texelFetch(beyond_image, in_tile, 0));
}

// A row of texels, interpolated at the left and the right pixel of the middle one.
struct Pair {
  vec4 left;
  vec4 right;
};
Pair pair_of(vec4 a, vec4 b, vec4 c) { return Pair(mix(b, a, 0.25), mix(b, c, 0.25)); }
Pair far_pair(ivec2 texel) {
  return pair_of(far_texel(texel - ivec2(1, 0)), far_texel(texel), far_texel(texel + ivec2(1, 0)));
}
struct NearPair {
  Near left;
  Near right;
};
NearPair near_pair(ivec2 texel) {
  Near none = Near(vec4(0.0), vec4(0.0));
  if (kNear == 0u) return NearPair(none, none);
  Near here = near_texel(texel);
  return NearPair(mix_near(here, near_texel(texel - ivec2(1, 0)), 0.25),
                  mix_near(here, near_texel(texel + ivec2(1, 0)), 0.25));
}

// A column of layer texels, from top to bottom, with 2×2 pixels each. Three rows are kept, so each is fetched once.
void compose_column(ivec2 first) {
  Pair far_above = far_pair(first - ivec2(0, 1)), far_here = far_pair(first);
  NearPair near_above = near_pair(first - ivec2(0, 1)), near_here = near_pair(first);
  for (int row = 0; row < kRows; ++row) {
    ivec2 texel = first + ivec2(0, row), pixel = 2 * texel;
    Pair far_below = far_pair(texel + ivec2(0, 1));
    NearPair near_below = near_pair(texel + ivec2(0, 1));
    vec4 depths = textureGather(depth_image, vec2(pixel + 1) * dof.inverse_size);
    compose(pixel, depths.w, mix(far_here.left, far_above.left, 0.25), mix_near(near_here.left, near_above.left, 0.25));
    compose(pixel + ivec2(1, 0), depths.z, mix(far_here.right, far_above.right, 0.25),
            mix_near(near_here.right, near_above.right, 0.25));
    compose(pixel + ivec2(0, 1), depths.x, mix(far_here.left, far_below.left, 0.25),
            mix_near(near_here.left, near_below.left, 0.25));
    compose(pixel + ivec2(1, 1), depths.y, mix(far_here.right, far_below.right, 0.25),
            mix_near(near_here.right, near_below.right, 0.25));
    far_above = far_here;
    far_here = far_below;
    near_above = near_here;
    near_here = near_below;
  }
}

void main() {
  DofTile tile;
  if (!listed_tile(kNear != 0u ? uint(GLOAM_DOF_COMPOSE_BOTH) : uint(GLOAM_DOF_COMPOSE_FAR), tile)) return;
  beyond_is_written = texelFetch(reach_image, tile.place, 0).w > 0.0;
  tile_corner = tile.place * (GLOAM_DOF_TILE / int(kScale));
  ivec2 local = ivec2(gl_LocalInvocationID.x, int(gl_LocalInvocationID.y) * kRows);
  if (kScale == 2u) {
    compose_column(tile.place * (GLOAM_DOF_TILE / 2) + local);
    return;
  }
  for (int block = 0; block < 4; ++block)
    for (int row = 0; row < kRows; ++row) {
      ivec2 pixel =
          tile.place * GLOAM_DOF_TILE + local + ivec2(block & 1, block >> 1) * GLOAM_DOF_BLOCK + ivec2(0, row);
      Near near = Near(vec4(0.0), vec4(0.0));
      if (kNear != 0u) near = near_texel(pixel);
      compose(pixel, texelFetch(depth_image, min(pixel, ivec2(dof.size) - 1), 0).r, far_texel(pixel), near);
    }
}
