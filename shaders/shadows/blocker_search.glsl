// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_BLOCKER_SEARCH_GLSL
#define GLOAM_SHADERS_SHADOWS_BLOCKER_SEARCH_GLSL

#include "shaders/shadows/shadow_taps.glsl"

// Where blockers can be that hide part of the light from a receiver: a square round it as wide as the penumbra of the nearest thing in it.
struct SearchRegion {
  float width;     // texels of mip 0
  float nearest;   // depth; not less than the nearest in the region
  float farthest;  // not more than the farthest in the region; 0: unknown
};

float nearest_of(vec4 v) { return max(max(v.x, v.y), max(v.z, v.w)); }
float farthest_of(vec4 v) { return min(min(v.x, v.y), min(v.z, v.w)); }

float penumbra_width(ShadowPoint p, float blocker) { return clamp(p.scale * (blocker - p.depth), 0.0, p.size); }

// The pyramid's level whose texel is at least this wide; there, two by two texels hold a square of that width round any point.
int pyramid_level(float width, int last) {
  return clamp(ceil_log2(max(width, 1.0)) - GLOAM_SHADOW_PYRAMID_MIP, 0, last);
}

vec2 pyramid_corner(ShadowPoint p, int level) {
  MipSquare square = mip_square(p.origin * 0.25, p.size * 0.25, level, shadow_block.atlas_size * 0.25);
  vec2 corner = floor(p.at * 0.25 / square.texel - 0.5) + 1.0;
  return (square.corner + clamp(corner, vec2(1.0), vec2(square.size - 1.0))) * 4.0 * shadow_texel_size();
}

// Nearest depth of all faces of a cube, as any of them may see what another holds within its field of view twice over.
float nearest_of_cube(ShadowPoint p) {
  float nearest = 0.0;
  int last = floor_log2(p.size) - GLOAM_SHADOW_PYRAMID_MIP;
  for (int face = 0; face < 6; ++face) {
    MipSquare square = mip_square(cube_face_origin(p.light, face) * 0.25, p.size * 0.25, last, shadow_block.atlas_size * 0.25);
    float factor = face == p.face ? 1.0 : 2.0;
    nearest = max(nearest, factor * texelFetch(shadow_pyramid, ivec2(square.corner), 0).y);
  }
  return nearest;
}

// Nearest depth of a square that other faces of a cube have part in, from nine of the pyramid's texels.
float nearest_across_faces(ShadowPoint p, float width) {
  int last = floor_log2(p.size) - GLOAM_SHADOW_PYRAMID_MIP;
  int level = pyramid_level(0.5 * width, last);
  mat3 own = cube_face_axes(p.face);
  float to_tangent = p.tan_half * 2.0 / p.size;
  float nearest = 0.0;
  for (int i = 0; i < 9; ++i) {
    vec2 tangent = (p.at + 0.5 * width * vec2(i % 3 - 1, i / 3 - 1) - 0.5 * p.size) * to_tangent;
    vec3 v = own * vec3(tangent.x, -tangent.y, 1.0);
    int face = cube_face_of(v);
    vec3 local = v * cube_face_axes(face);
    vec2 there = vec2(local.x, -local.y) / local.z / to_tangent + 0.5 * p.size;
    MipSquare square = mip_square(cube_face_origin(p.light, face) * 0.25, p.size * 0.25, level, shadow_block.atlas_size * 0.25);
    vec2 cell = clamp(floor(there * 0.25 / square.texel), vec2(0.0), vec2(square.size - 1.0));
    nearest = max(nearest, texelFetch(shadow_pyramid, ivec2(square.corner + cell), 0).y * local.z);
  }
  return nearest;
}

// From coarse to fine: the nearest thing in a square that is too large gives a smaller one that is still large enough.
SearchRegion find_region(ShadowPoint p) {
  int last = floor_log2(p.size) - GLOAM_SHADOW_PYRAMID_MIP - 1;
  SearchRegion region = SearchRegion(p.size, 0.0, 0.0);
  bool across = false;
  if (p.face >= 0) do {
    region.width = penumbra_width(p, nearest_of_cube(p));
    across = leaves_cube_face(p, 0.5 * region.width);
    int step = 0;
    if (across) do {
      region.nearest = nearest_across_faces(p, region.width);
      region.width = min(region.width, penumbra_width(p, region.nearest));
    } while (++step < 2);
    across = across && leaves_cube_face(p, 0.5 * region.width);
  } while (never(p));
  if (!across) do {
    vec2 corner = pyramid_corner(p, last);
    for (int step = 0; step < 2; ++step) {
      region.width = penumbra_width(p, nearest_of(textureGather(shadow_pyramid, corner, 1)));
      corner = pyramid_corner(p, pyramid_level(region.width, last));
    }
    region.nearest = nearest_of(textureGather(shadow_pyramid, corner, 1));
    region.farthest = farthest_of(textureGather(shadow_pyramid, corner, 0));
    region.width = penumbra_width(p, region.nearest);
  } while (never(p));
  return region;
}

struct Blockers {
  float count;  // weighted; (N − 1)² when every texel blocks
  float depth;  // of their mean distance; that of the receiver when there are none
};

// Blockers of N × N texels with bilinear edges, (N / 2)² gathers. whole_plane: the receiver's plane counts as far as the kernel goes, for a kernel
// that is as wide as it is whatever the light; without it, blockers are nearer to the light than the receiver.
Blockers find_blockers(ShadowPoint p, int mip, int texels, bool whole_plane) {
  Kernel k = make_kernel(p, mip, texels);
  float least = whole_plane ? p.least : max(k.least, p.threshold);
  vec4 count = vec4(0.0), sum = vec4(0.0);
  for (int y = 0; y < texels; y += 2) {
    vec2 share_y = vec2(y == 0 ? 1.0 - k.fraction.y : 1.0, y + 2 == texels ? k.fraction.y : 1.0);
    float corner_y = clamp_corner(k, k.base.y + float(y) + 1.0);
    for (int x = 0; x < texels; x += 2) {
      vec2 share_x = vec2(x == 0 ? 1.0 - k.fraction.x : 1.0, x + 2 == texels ? k.fraction.x : 1.0);
      vec2 corner = vec2(clamp_corner(k, k.base.x + float(x) + 1.0), corner_y);
      vec4 depth = gather_depth(k, corner);
      vec4 threshold = gather_threshold(k, corner, least);
      vec4 weight = share_x.xyyx * share_y.yyxx * vec4(greaterThan(depth, threshold));
      count += weight;
      sum += weight * (p.orthographic ? depth : 1.0 / max(depth, threshold));
    }
  }
  float total = dot(count, vec4(1.0));
  float mean = dot(sum, vec4(1.0)) / max(total, 1e-6);
  return Blockers(total, total <= 1e-6 ? p.depth : p.orthographic ? mean : 1.0 / mean);
}

// The same where other faces of a cube have part in it: texel by texel.
Blockers find_blockers_across(ShadowPoint p, int mip, int texels, bool whole_plane) {
  Kernel k = make_kernel(p, mip, texels);
  float least = whole_plane ? p.least : max(k.least, p.threshold);
  float count = 0.0, sum = 0.0;
  for (int i = 0; i < texels * texels; ++i) {
    vec2 cell = vec2(i % texels, i / texels);
    vec2 share = edge_shares(k.fraction, cell, float(texels));
    vec2 at = (k.base + cell + 0.5) * k.square.texel;
    float rise;
    float depth = cube_depth(p, at, mip, rise);
    float threshold = tap_threshold(p, k, at, least, rise);
    float weight = depth > threshold ? share.x * share.y : 0.0;
    count += weight;
    sum += weight / max(depth, threshold);
  }
  return Blockers(count, count <= 1e-6 ? p.depth : count / sum);
}

Blockers box_blockers(ShadowPoint p, int mip, int texels, bool whole_plane) {
  Blockers found = Blockers(0.0, p.depth);
  bool across = leaves_cube_face(p, kernel_reach(mip, texels));
  if (!across) do {
    found = find_blockers(p, mip, texels, whole_plane);
  } while (never(p));
  if (across) do {
    found = find_blockers_across(p, mip, texels, whole_plane);
  } while (never(p));
  return found;
}

#endif
