// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_TILE_BOUNDS_GLSL
#define GLOAM_SHADERS_SHADOWS_TILE_BOUNDS_GLSL

#include "shaders/common/math.glsl"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"

// Bounds of the surfaces in a shadow tile: positions, planes and normals. Sky is left out. The pixels of a tile are in
// one or two groups, so that at an edge each group has one orientation and one plane.

// Bounds of one group.
struct TileBounds {
  vec3 corners[8];       // camera-relative; their convex hull holds every surface point of the group
  vec3 center;           // mean of the corners
  float radius;          // radius of a sphere around the center that holds the corners
  vec3 normal;           // face normal of a few of the pixels, unit
  float spread;          // greatest length of the difference between `normal` and a pixel's face normal
  float shading_spread;  // the same for shading normals
  vec2 offsets;          // least and greatest dot(normal, position) of the pixels
  vec2 depths;           // least and greatest depth of the pixels (reversed Z)
  vec2 first, last;      // pixels of the group: least and greatest coordinates
  bool subsurface;       // any pixel has a subsurface material
};

struct TileGroups {
  TileBounds one, two;
  bool has_two;
};

// A pixel of the tile that has a surface.
struct TilePixel {
  vec2 at;
  float depth;
  vec3 position;  // camera-relative
  vec3 normal;    // face normal
  vec3 shading_normal;
  bool subsurface;
};

TileBounds empty_bounds() {
  TileBounds t;
  t.normal = vec3(0.0, 1.0, 0.0);
  t.spread = t.shading_spread = 0.0;
  t.offsets = vec2(1e30, -1e30);
  t.depths = vec2(1.0, 0.0);
  t.first = vec2(1e9);
  t.last = vec2(-1e9);
  t.subsurface = false;
  return t;
}

// Widens the bounds by a pixel, if it belongs to the group.
void add_pixel(inout TileBounds t, bool belongs, TilePixel p) {
  float along = dot(t.normal, p.position);
  t.spread = belongs ? max(t.spread, length(p.normal - t.normal)) : t.spread;
  t.shading_spread = belongs ? max(t.shading_spread, length(p.shading_normal - t.normal)) : t.shading_spread;
  t.offsets = belongs ? vec2(min(t.offsets.x, along), max(t.offsets.y, along)) : t.offsets;
  t.depths = belongs ? vec2(min(t.depths.x, p.depth), max(t.depths.y, p.depth)) : t.depths;
  t.first = belongs ? min(t.first, p.at) : t.first;
  t.last = belongs ? max(t.last, p.at) : t.last;
  t.subsurface = t.subsurface || (belongs && p.subsurface);
}

// How far a pixel is from the orientation and the plane of a group: at most 1 for those that fit.
// plane: dot(normal, position) of the group's first pixel. size: of the tile in metres.
float misfit(TileBounds t, float plane, float size, TilePixel p) {
  const float most_difference = 0.2;
  return max(length(p.normal - t.normal) / most_difference, abs(dot(t.normal, p.position) - plane) / size);
}

// The two factors of `ray`, ascending, at which the ray meets the planes with these offsets. Both −1 if the ray is
// nearly parallel to the planes.
vec2 between_planes(vec3 ray, vec3 normal, vec2 offsets) {
  float along = dot(ray, normal);
  if (abs(along) < 1e-4 * length(ray)) return vec2(-1.0);
  vec2 t = offsets / along;
  return t.x <= t.y ? t : t.yx;
}

// Sets the corners. The rays through the corners of the group's pixels are cut at the group's nearest and farthest
// depth, or, when that is tighter, at the planes through its nearest and farthest pixels. All four rays are cut in the
// same way, so the convex hull of the cut points holds the surfaces.
void set_corners(ViewConstants view, inout TileBounds t) {
  // Margin for the rounding of dot products.
  float slack = 1e-6 * (abs(t.offsets.x) + abs(t.offsets.y));
  t.offsets += vec2(-slack, slack);
  vec2 first = t.first - 0.5, last = t.last + 0.5;
  bool perspective = view.ray_base.w > 0.0;
  float reach = t.depths.y / t.depths.x;
  vec2 ranges[4];
  bool planes = perspective;
  for (int i = 0; i < 4; ++i) {
    vec2 corner = vec2((i & 1) != 0 ? last.x : first.x, (i & 2) != 0 ? last.y : first.y);
    t.corners[i] = relative_position(view, corner, t.depths.y);
    t.corners[i + 4] = relative_position(view, corner, t.depths.x);
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

// A few pixels of the tile give the first group its orientation and its plane. The first pixel that does not fit gives
// them to the second group, and each pixel after it belongs to the group that it fits better.
TileGroups make_tile_groups(ViewConstants view, sampler2D depth_image, usampler2D normal_image, sampler2D color_image,
                            uvec2 tile) {
  TileGroups g = TileGroups(empty_bounds(), empty_bounds(), false);
  ivec2 first = ivec2(tile) * GLOAM_SHADOW_TILE;
  // The mean of those of four normals that are like the first of them. Normals of pixels without a surface are
  // undefined.
  vec3 sum = vec3(0.0);
  vec2 planes = vec2(0.0);  // of the groups: dot(normal, position) of a pixel
  vec3 at_first = vec3(0.0);
  float size = 1e30;
  for (int i = 0; i < 4; ++i) {
    ivec2 at = min(first + ivec2(2 + 3 * (i & 1), 2 + 3 * (i >> 1)), ivec2(view.size) - 1);
    float depth = texelFetch(depth_image, at, 0).r;
    vec3 normal = unpack_normal(texelFetch(normal_image, at, 0).y);
    bool none = sum == vec3(0.0);
    if (depth > 0.0 && none) {
      at_first = relative_position(view, vec2(at), depth);
      size = distance(at_first, relative_position(view, vec2(at + GLOAM_SHADOW_TILE), depth));
    }
    if (depth > 0.0 && (none || dot(normal, sum) > 0.95 * length(sum))) sum += normal;
  }
  bool has_one = sum != vec3(0.0);
  g.one.normal = has_one ? normalize(sum) : g.one.normal;
  planes.x = dot(g.one.normal, at_first);
  for (int i = 0; i < GLOAM_SHADOW_TILE * GLOAM_SHADOW_TILE / 4; ++i) {
    ivec2 quad = first + 2 * ivec2(i & 3, i >> 2);
    vec2 corner = vec2(quad + 1) * view.inverse_size;
    vec4 depths = textureGather(depth_image, corner);
    uvec4 shading_normals = textureGather(normal_image, corner, 0), normals = textureGather(normal_image, corner, 1);
    vec4 flags = textureGather(color_image, corner, 3);
    for (int k = 0; k < 4; ++k) {
      const ivec2 offsets[4] = ivec2[](ivec2(0, 1), ivec2(1, 1), ivec2(1, 0), ivec2(0, 0));  // in the order of a gather
      ivec2 at = quad + offsets[k];
      bool surface = depths[k] > 0.0 && all(lessThan(at, ivec2(view.size)));
      TilePixel p = TilePixel(vec2(at), depths[k], relative_position(view, vec2(at), max(depths[k], 1e-9)),
                              unpack_normal(normals[k]), unpack_normal(shading_normals[k]), flags[k] > 0.5);
      if (surface && !has_one) {
        g.one.normal = p.normal;
        planes.x = dot(p.normal, p.position);
        size = distance(p.position, relative_position(view, vec2(at + GLOAM_SHADOW_TILE), depths[k]));
        has_one = true;
      }
      float from_one = misfit(g.one, planes.x, size, p);
      if (surface && !g.has_two && from_one > 1.0) {
        g.two.normal = p.normal;
        planes.y = dot(p.normal, p.position);
        g.has_two = true;
      }
      bool in_one = !g.has_two || from_one <= 1.0 || from_one <= misfit(g.two, planes.y, size, p);
      add_pixel(g.one, surface && in_one, p);
      add_pixel(g.two, surface && !in_one, p);
    }
  }
  // The pixels of the tile's few normals may all fit the second group better.
  if (g.one.depths.y <= 0.0) {
    g.one = g.two;
    g.has_two = false;
  }
  set_corners(view, g.one);
  if (g.has_two) set_corners(view, g.two);
  return g;
}

#endif
