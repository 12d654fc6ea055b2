// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_TILE_BOUNDS_GLSL
#define GLOAM_SHADERS_SHADOWS_TILE_BOUNDS_GLSL

#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"
#include "shaders/shadows/final_lists_shared.h"

// Bounds of the surfaces of a group of pixels in a shadow tile: positions, planes and normals. Include this after
// shadows_api.glsl.

struct TileBounds {
  vec3 corners[8];       // camera-relative; their convex hull holds every position of the group
  vec3 center;           // mean of the corners
  float radius;          // radius of a sphere around the center that holds the corners
  vec3 normal;           // as in ShadowTileGroup
  float spread;          // as in ShadowTileGroup
  float shading_spread;  // as in ShadowTileGroup
  vec2 offsets;          // as in ShadowTileGroup
  bool subsurface;       // any pixel has a subsurface material
  bool transmits;        // light from behind reaches any pixel
};

// The two factors of `ray`, ascending, at which the ray meets the planes with these offsets. Both −1 if the ray is
// nearly parallel to the planes.
vec2 between_planes(vec3 ray, vec3 normal, vec2 offsets) {
  float along = dot(ray, normal);
  if (abs(along) < 1e-4 * length(ray)) return vec2(-1.0);
  vec2 t = offsets / along;
  return t.x <= t.y ? t : t.yx;
}

// Replaces the corners by those of a box around them that also holds the smooth surfaces, up to `lift` metres away.
void lift_corners(inout TileBounds t, float lift) {
  vec3 side = t.corners[1] - t.corners[0];
  vec3 across = side - t.normal * dot(side, t.normal);
  if (!(dot(across, across) > 1e-8 * dot(side, side))) across = cross(t.normal, t.normal.yzx + vec3(0.3, 0.2, 0.1));
  across = normalize(across);
  mat3 axes = mat3(across, cross(t.normal, across), t.normal);
  vec3 low = vec3(1e30), high = vec3(-1e30);
  for (int i = 0; i < 8; ++i) {
    vec3 along = t.corners[i] * axes;
    low = min(low, along);
    high = max(high, along);
  }
  // Margin for the rounding of positions and dot products.
  float slack = lift + 2e-6 * (length(low) + length(high));
  low = vec3(low.xy - slack, t.offsets.x);
  high = vec3(high.xy + slack, t.offsets.y);
  t.center = axes * (0.5 * (low + high));
  t.radius = 0.5 * length(high - low) + 1e-6 * (abs(t.center.x) + abs(t.center.y) + abs(t.center.z));
  for (int i = 0; i < 8; ++i) t.corners[i] = axes * mix(low, high, vec3(notEqual(ivec3(i) & ivec3(1, 2, 4), ivec3(0))));
}

// The rays through the corners of the group's pixels are cut at the group's nearest and farthest
// depth, or, when that is tighter, at the planes through its nearest and farthest pixels. All four rays are cut in the
// same way, so the convex hull of the cut points holds the surfaces.
TileBounds tile_bounds(ViewConstants view, uvec2 tile, ShadowTileGroup g) {
  TileBounds t;
  t.normal = g.normal;
  t.spread = g.spread;
  t.shading_spread = g.shading_spread;
  t.subsurface = (g.pixels & GLOAM_GROUP_SUBSURFACE) != 0u;
  t.transmits = (g.pixels & GLOAM_GROUP_TRANSMITS) != 0u;
  // Margin for the rounding of dot products.
  float slack = 1e-6 * (abs(g.offsets.x) + abs(g.offsets.y));
  t.offsets = g.offsets + vec2(-slack, slack);
  uvec4 pixels = uvec4(g.pixels) >> uvec4(0u, 3u, 6u, 9u) & 7u;
  vec2 corner = vec2(tile * uint(GLOAM_SHADOW_TILE));
  vec2 first = corner + vec2(pixels.xy) - 0.5, last = corner + vec2(pixels.zw) + 0.5;
  bool perspective = view.ray_base.w > 0.0;
  float reach = g.depths.y / g.depths.x;
  vec2 ranges[4];
  bool planes = perspective;
  for (int i = 0; i < 4; ++i) {
    vec2 at = vec2((i & 1) != 0 ? last.x : first.x, (i & 2) != 0 ? last.y : first.y);
    t.corners[i] = relative_position(view, at, g.depths.y);
    t.corners[i + 4] = relative_position(view, at, g.depths.x);
    ranges[i] = between_planes(t.corners[i], t.normal, t.offsets);
    planes = planes && ranges[i].x > 0.5 && ranges[i].y < 2.0 * reach && ranges[i].y - ranges[i].x < reach - 1.0;
  }
  t.center = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    // In a perspective view the far corner is a multiple of the near one.
    vec3 near = t.corners[i];
    if (planes) {
      t.corners[i] = near * ranges[i].x;
      t.corners[i + 4] = near * ranges[i].y;
    }
    t.center += 0.125 * (t.corners[i] + t.corners[i + 4]);
  }
  t.radius = 0.0;
  for (int i = 0; i < 8; ++i) t.radius = max(t.radius, distance(t.center, t.corners[i]));
  // Margin for the rounding of positions.
  t.radius += 1e-6 * (abs(t.center.x) + abs(t.center.y) + abs(t.center.z));
  if (kTerminator != 0u && g.pixels >> 16 != 0u) lift_corners(t, unpackHalf2x16(g.pixels).y);
  return t;
}

#endif
