// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_CLOSEUPS_CLOSEUPS_SHARED_H
#define GLOAM_SHADERS_CLOSEUPS_CLOSEUPS_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// A pair of a subject and a light: its face of the close-up map, and the shadow tiles it is composed into.
struct CloseupConstants {
  // Perspective: as a ShadowRow of a spot light.
  float near_m;
  float width_m;  // diameter of the emitter
  float tan_half;
  float tan_inner;
  vec3 right;  // of the face, world
  float size;  // texels of the face's side
  vec3 up;
  float penumbra_m_per_m;  // of a directional light
  // Orthographic: as a ShadowCascade.
  vec4 row_u;       // dot(row, (camera-relative position, 1)): texels from the face's corner, x
  vec4 row_v;       // y
  vec4 row_depth;   // reversed depth
  vec3 direction;   // where the light shines
  float brightest;  // lux
  float texel_m;
  float depth_m;  // metres from depth 1 to depth 0
  vec2 origin;    // of the face in the close-up map, texels
  uvec2 first_tile;
  uint light;  // index among the view's local, or directional, lights
  uint reserved;
};

/// Moves what a pair's map holds into a part of a standard face of the same light, which lies in the atlas. Points are
/// in texels of a face, from its corner.
struct CloseupTransfer {
  // Where a point p = (x, y, 1) of the standard face lies in the pair's: (dot(row_u, p), dot(row_v, p)) / dot(row_w,
  // p).
  vec3 row_u;
  vec3 row_v;
  vec3 row_w;  // not positive: behind the pair's face
  // A depth d at q = (x, y, 1) of the pair's face is (depth_scale · d + dot(depth_row, q)) / dot(depth_w, q) in the
  // standard one.
  vec3 depth_row;
  vec3 depth_w;
  float depth_scale;
  // Where q lies in the standard face: (dot(back_u, q), dot(back_v, q)) / dot(depth_w, q).
  vec3 back_u;
  vec3 back_v;
  uvec2 begin;  // of the part
  uvec2 end;
  uvec2 origin;       // of the pair's face in the close-up map
  uint size;          // texels of its side
  uint map_size;      // of the close-up map
  uvec2 target;       // of the standard face in the atlas
  uint depth_bits;    // mask of a depth's bits that mip 0 of the atlas holds
  uint orthographic;  // what is nearer than the standard face's near side stands at it; else nobody sees it
};

GLOAM_SHARED_END

#endif
