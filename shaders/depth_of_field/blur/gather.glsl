// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_GATHER_GLSL
#define GLOAM_SHADERS_DEPTH_OF_FIELD_BLUR_GATHER_GLSL

#include "shaders/depth_of_field/depth_of_field_shared.h"
#include "shaders/depth_of_field/kernel_api.glsl"

// Gathers one layer at the texels of one level of a tile. A texel counts where its own circle reaches, by one over the
// circle's area: the light that it would scatter. Include this after keep() and kept(), which store texels of the layer
// in workgroup memory, or with kKeeps = 0. Thief, section 1.5.2, fetches the texels of a line once; here a workgroup
// fetches those of a block.

layout(local_size_x_id = 2) in;
layout(constant_id = 2) const int kThreads = GLOAM_DOF_THREADS;
layout(constant_id = 1) const uint kNear = 0u;  // 1: the near layer

layout(set = 0, binding = 0, scalar) uniform Dof { DofConstants dof; };
layout(set = 0, binding = 1) uniform sampler2D layer_image;
layout(set = 0, binding = 2, rgba16f) uniform writeonly image2D blurred_image;

#define GLOAM_DOF_LIST_BINDING 3
#include "shaders/depth_of_field/blur/layer.glsl"
#include "shaders/depth_of_field/levels_api.glsl"
#include "shaders/depth_of_field/list_api.glsl"

ivec2 size, corner;  // of the level
ivec2 kept_first;    // texel of the level that is kept at place 0
int kept_side;

vec4 fetch_layer(ivec2 texel) { return texelFetch(layer_image, corner + inside_level(texel, size), 0); }
int place_of(ivec2 texel) { return (texel.y - kept_first.y) * kept_side + texel.x - kept_first.x; }
vec4 layer_at(ivec2 texel) { return kKeeps != 0 ? kept(place_of(texel)) : fetch_layer(texel); }

// Texels of a row that lie within the square of a distance. Loops over them test at their end: a processor goes once
// more through a loop that tests first.
int row_end(int texels, int y) { return int(sqrt(float(texels - y * y) + 0.25)); }

// What lies behind the texel's surface, or in the same plane, counts as far as the texel's own circle reaches. What
// lies before it covers it.
vec4 blurred_far(ivec2 texel, vec4 own, int taps, int texels) {
  vec4 front = vec4(0.0), back = vec4(0.0);
  for (int y = -taps; y <= taps; ++y) {
    int end = row_end(texels, y), x = -end;
    do {
      vec4 other = layer_at(texel + ivec2(x, y));
      float reach = min(other.a, own.a);
      float cover = other.a > 0.0 ? aperture_cover(aperture_distance(vec2(x, y)), reach) : 0.0;
      // Texels behind have one area. Those without weight may not have been written.
      bool before = other.a < own.a;
      float weight = before ? cover / aperture_area(reach) : cover;
      vec4 counted = cover > 0.0 ? weight * vec4(other.rgb, 1.0) : vec4(0.0);
      front += before ? counted : vec4(0.0);
      back += before ? vec4(0.0) : counted;
    } while (++x <= end);
  }
  front /= max(front.a, 1.0);
  vec3 light = front.rgb + (1.0 - front.a) * back.rgb / max(back.a, 1e-9);
  return own.a > 0.0 ? vec4(light, 1.0) * (own.a / float(GLOAM_DOF_ROOM)) : vec4(0.0);
}

// Behind objects before the focus: the light that is visible near them, the nearest most.
vec4 filled_far(ivec2 texel, int taps, int texels) {
  vec4 fill = vec4(0.0);
  for (int y = -taps; y <= taps; ++y) {
    int end = row_end(texels, y), x = -end;
    do {
      vec4 other = layer_at(texel + ivec2(x, y));
      float squared = float(x * x + y * y) + 0.25;
      fill += other.a > kNothing ? vec4(other.rgb, 1.0) / (squared * squared) : vec4(0.0);
    } while (++x <= end);
  }
  return fill.a > 0.0 ? vec4(fill.rgb / fill.a, 1.0) * kFilledWeight : vec4(0.0);
}

vec4 far_texel(ivec2 texel, int taps, int texels, int fills) {
  vec4 own = layer_at(texel);
  // Texels in focus have no blurred light.
  vec4 light = blurred_far(texel, own, taps, texels);
  // A loop in place of a condition: lavapipe runs both sides of a branch.
  for (int i = 0; i < fills; ++i) light = own.a < 0.0 ? filled_far(texel, taps, texels) : light;
  return light;
}

vec4 near_texel(ivec2 texel, int taps, int texels) {
  vec4 sum = vec4(0.0);
  float radii = 0.0;
  for (int y = -taps; y <= taps; ++y) {
    int end = row_end(texels, y), x = -end;
    do {
      vec4 other = layer_at(texel + ivec2(x, y));
      float radius = near_radius(other.a);
      float weight = aperture_cover(aperture_distance(vec2(x, y)), radius) / aperture_area(radius);
      weight *= near_share(other.a) > 0.0 ? 1.0 : 0.0;
      sum += weight * vec4(other.rgb, near_share(other.a));
      radii += weight * near_share(other.a) * radius;
    } while (++x <= end);
  }
  // Few texels do not add up to the area of a disc.
  float radius = max(radii / max(sum.a, 1e-9), 0.5);
  sum *= aperture_area(radius) / aperture_sum(radius);
  return sum / max(sum.a, 1.0);
}

void main() {
  DofTile tile;
  if (!listed_tile(kNear != 0u ? uint(GLOAM_DOF_NEAR) : uint(GLOAM_DOF_FAR), tile)) return;
  int side = GLOAM_DOF_TILE >> tile.level, number = int(gl_LocalInvocationIndex);
  size = level_size(tile.level);
  corner = dof.corner[tile.level];
  ivec2 first = tile.place * side;
  bool empty = (tile.work & GLOAM_DOF_EMPTY) != 0;
  int texels = tile.work & (GLOAM_DOF_FILLS - 1), fills = (tile.work & GLOAM_DOF_FILLS) != 0 ? 1 : 0;
  int taps = empty ? -1 : int(sqrt(float(texels)));
  if (kKeeps != 0 && !empty) {
    kept_first = first - taps;
    kept_side = side + 2 * taps;
    for (int i = number; i < kept_side * kept_side; i += kThreads) {
      ivec2 texel = kept_first + ivec2(i % kept_side, i / kept_side);
      keep(i, fetch_layer(texel));
    }
  }
  if (kKeeps != 0) barrier();
  for (int i = number; i < side * side; i += kThreads) {
    ivec2 texel = first + ivec2(i & (side - 1), i >> (4 - tile.level));
    vec4 light = kNear != 0u ? near_texel(texel, taps, texels) : far_texel(texel, taps, texels, fills);
    if (empty) light = vec4(0.0);
    if (all(lessThan(texel, size))) imageStore(blurred_image, corner + texel, min(light, vec4(65504.0)));
  }
}

#endif
