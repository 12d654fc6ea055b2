// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_CLOSEUPS_CLOSEUPS_SHARED_H
#define GLOAM_SHADERS_CLOSEUPS_CLOSEUPS_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// A close-up pair: its face in the close-up map, and the first tile of its umbra range.
struct CloseupConstants {
  // Perspective: as in the ShadowRow of a spot light.
  float near_m;
  float emitter_diameter_m;
  float tan_half;
  float tan_inner;
  vec3 right;  // axis of the face, world
  float size;  // side of the face in texels
  vec3 up;
  float penumbra_m_per_m;  // directional light: width of the penumbra per metre between blocker and receiver
  // Orthographic: as in a ShadowCascade.
  vec4 row_u;       // dot(row, (camera-relative position, 1)): texels from the face's corner, x
  vec4 row_v;       // y
  vec4 row_depth;   // reversed depth
  vec3 direction;   // direction in which the light shines
  float brightest;  // lux, of the brightest channel
  float texel_m;
  float depth_m;     // distance between depth 1 and depth 0, metres
  vec2 origin;       // corner of the face in the close-up map, texels
  uvec2 first_tile;  // umbra range: shadow tiles [first_tile, end_tile)
  uvec2 end_tile;
  uint light;  // index among the view's local or directional lights
  uint pair;   // index of the pair's indirect command: number of workgroups, and in w the number of its listed tiles
  uint first_item;  // index of the first listed tile
};

/// Constants to transfer the depths of a pair's face to a rectangle of a standard face of the same light. The standard
/// face lies in the atlas. Points are in texels from the corner of their face.
struct CloseupTransfer {
  // Point of the pair's face at point p = (x, y, 1) of the standard face: (dot(row_u, p), dot(row_v, p)) / dot(row_w,
  // p).
  vec3 row_u;
  vec3 row_v;
  vec3 row_w;  // dot(row_w, p) ≤ 0: p is behind the pair's face
  // Depth in the standard face of a depth d at q = (x, y, 1) of the pair's face: (depth_scale · d + dot(depth_row, q))
  // / dot(depth_w, q).
  vec3 depth_row;
  vec3 depth_w;
  float depth_scale;
  // Point of the standard face at q: (dot(back_u, q), dot(back_v, q)) / dot(depth_w, q).
  vec3 back_u;
  vec3 back_v;
  uvec2 begin;  // rectangle [begin, end) of the standard face
  uvec2 end;
  uvec2 origin;       // corner of the pair's face in the close-up map
  uint size;          // side of the pair's face, texels
  uint map_size;      // side of the close-up map, texels
  uvec2 target;       // corner of the standard face in the atlas
  uint depth_bits;    // mask of the bits of a float depth that mip 0 of the atlas stores
  uint orthographic;  // 1: depths nearer than the standard face's near side are clamped to it; 0: they are dropped
};

GLOAM_SHARED_END

#endif
