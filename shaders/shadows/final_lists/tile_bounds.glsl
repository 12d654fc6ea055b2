// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_TILE_BOUNDS_GLSL
#define GLOAM_SHADERS_SHADOWS_TILE_BOUNDS_GLSL

#include "shaders/common/math.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"

// Bounds of the surfaces in a shadow tile: positions, planes and normals. Sky is left out.

struct TileBounds {
  vec3 corners[8];  // camera-relative; their convex hull holds every surface point of the tile
  vec3 center;      // mean of the corners
  float radius;     // radius of a sphere around the center that holds the corners
  vec3 normal;      // mean face normal of a few of the pixels, unit
  float spread;     // greatest length of the difference between `normal` and a pixel's face normal
  vec2 offsets;     // least and greatest dot(normal, position) of the pixels
  bool subsurface;  // any pixel has a subsurface material
};

// Widens spread and offsets by the four pixels of a quad.
void add_quad(ViewConstants view, ivec2 pixel, vec4 depths, uvec4 normals, inout TileBounds t) {
  const ivec2 offsets[4] = ivec2[](ivec2(0, 1), ivec2(1, 1), ivec2(1, 0), ivec2(0, 0));  // in the order of a gather
  for (int i = 0; i < 4; ++i) {
    ivec2 at = pixel + offsets[i];
    bool surface = depths[i] > 0.0 && all(lessThan(at, ivec2(view.size)));
    vec3 normal = unpack_normal(normals[i]);
    float along = dot(t.normal, relative_position(view, vec2(at), max(depths[i], 1e-9)));
    t.spread = surface ? max(t.spread, length(normal - t.normal)) : t.spread;
    t.offsets = surface ? vec2(min(t.offsets.x, along), max(t.offsets.y, along)) : t.offsets;
  }
}

// The two factors of `ray`, ascending, at which the ray meets the planes with these offsets. Both −1 if the ray is
// nearly parallel to the planes.
vec2 between_planes(vec3 ray, vec3 normal, vec2 offsets) {
  float along = dot(ray, normal);
  if (abs(along) < 1e-4 * length(ray)) return vec2(-1.0);
  vec2 t = offsets / along;
  return t.x <= t.y ? t : t.yx;
}

// Sets the corners. The rays through the tile's corners are cut at the tile's nearest and farthest depth, or, when that
// is tighter, at the planes through its nearest and farthest pixels. All four rays are cut in the same way, so the
// convex hull of the cut points holds the surfaces.
void set_corners(ViewConstants view, uvec2 tile, vec2 bounds, inout TileBounds t) {
  vec2 first = vec2(tile * uint(GLOAM_SHADOW_TILE)) - 0.5;
  vec2 last = min(first + float(GLOAM_SHADOW_TILE), vec2(view.size) - 0.5);
  bool perspective = view.ray_base.w > 0.0;
  float reach = bounds.y / bounds.x;
  vec2 ranges[4];
  bool planes = perspective;
  for (int i = 0; i < 4; ++i) {
    vec2 corner = vec2((i & 1) != 0 ? last.x : first.x, (i & 2) != 0 ? last.y : first.y);
    t.corners[i] = relative_position(view, corner, bounds.y);
    t.corners[i + 4] = relative_position(view, corner, bounds.x);
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
}

// bounds: farthest and nearest depth of the tile's surfaces (reversed Z), both above 0.
TileBounds make_tile_bounds(ViewConstants view, sampler2D depth_image, usampler2D normal_image, sampler2D color_image,
                            uvec2 tile, vec2 bounds) {
  TileBounds t;
  ivec2 first = ivec2(tile) * GLOAM_SHADOW_TILE;
  // Normals of pixels without a surface are undefined.
  vec3 sum = vec3(0.0, 1e-6, 0.0);
  for (int i = 0; i < 4; ++i) {
    ivec2 at = min(first + ivec2(2 + 3 * (i & 1), 2 + 3 * (i >> 1)), ivec2(view.size) - 1);
    if (texelFetch(depth_image, at, 0).r > 0.0) sum += unpack_normal(texelFetch(normal_image, at, 0).y);
  }
  t.normal = normalize(sum);
  t.spread = 0.0;
  t.offsets = vec2(1e30, -1e30);
  t.subsurface = false;
  for (int i = 0; i < 16; ++i) {
    ivec2 quad = first + 2 * ivec2(i & 3, i >> 2);
    vec2 corner = vec2(quad + 1) * view.inverse_size;
    add_quad(view, quad, textureGather(depth_image, corner), textureGather(normal_image, corner, 1), t);
    vec4 flags = textureGather(color_image, corner, 3);
    t.subsurface = t.subsurface || max(max(flags.x, flags.y), max(flags.z, flags.w)) > 0.5;
  }
  // Margin for the rounding of dot products.
  float slack = 1e-6 * (abs(t.offsets.x) + abs(t.offsets.y));
  t.offsets += vec2(-slack, slack);
  set_corners(view, tile, bounds, t);
  return t;
}

#endif
