// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_CLASSIFY_TILE_GLSL
#define GLOAM_SHADERS_SHADOWS_CLASSIFY_TILE_GLSL

#include "shaders/shadows/shadow_planes_shared.h"
#include "shaders/shadows/shadows_api.glsl"
#include "shaders/shadows/tile_bounds.glsl"

// What shadow maps tell of a whole tile and one light, before any pixel is asked. Conservative: it says lit or unlit only where the filter
// of every pixel of the tile says so, whatever the filter is; every bound here holds the pixel's own value with room for rounding.
//
// Lit: in the part of the map that the kernels of the tile's pixels may look at, every block of texels lies below the pixels' planes, or so
// far to the side that it is outside of the cone between pixel and emitter. Comparing with planes is what makes it work: a surface that
// slants toward the light is nearer to it beside every tile than in it. Unlit: the farthest texel there is nearer than all pixels.
//
// Before including this, define GLOAM_SHADOW_PLANES_BINDING.

layout(set = 0, binding = GLOAM_SHADOW_PLANES_BINDING) uniform sampler2D shadow_planes;

const uint kUnknown = 0u;
const uint kLit = 1u;
const uint kUnlit = 2u;
const uint kCastsNone = 3u;

const int kMostBlocks = 6;         // along a side of what is looked at
const float kPlaneMargin = 0.75;   // share of the bias that planes may differ by

// A tile in one face's texels and depths.
struct TileInFace {
  vec2 origin;        // of the face in the atlas, texels of mip 0
  float size;
  vec2 low, high;     // texels of mip 0 that hold the pixels
  float farthest;     // least and greatest depth of the pixels
  float nearest;
  vec3 plane;         // depth at texel (0, 0), and a texel to the right and down; below the planes of all pixels, but for their tilt
  float tilt;         // what a pixel's plane may lie below that a texel of distance
  float slope;        // bound of any pixel's slope_per_texel
  float scale;        // greatest of the pixels' ShadowPoint::scale
  float least_bias;   // depth
  float most_bias;
  bool cube;          // what leaves the face goes on in others
  bool surrounded;    // all pixels look at this face
  bool faces_light;   // all pixels see all of the emitter above their own surface
  bool turned_away;   // none sees any of it
};

// Texels [low, high] of the face; whatever is beyond it is left out.
float nearest_in(TileInFace f, vec2 low, vec2 high, out float farthest) {
  low = clamp(low, vec2(0.0), vec2(f.size)) * 0.25;
  high = clamp(high, vec2(0.0), vec2(f.size)) * 0.25;
  int last = floor_log2(f.size) - GLOAM_SHADOW_PYRAMID_MIP - 1;
  float side = max(high.x - low.x, high.y - low.y);
  int level = clamp(ceil_log2(max(side / 3.0, 1.0)), 0, last);
  MipSquare square = mip_square(f.origin * 0.25, f.size * 0.25, level, shadow_block.atlas_size * 0.25);
  // Four texels a side hold what is three of them wide; in the coarsest level two are all there is.
  vec2 first = floor(low / square.texel) + 1.0;
  float nearest = 0.0;
  farthest = 1.0;
  for (int i = 0; i < 4; ++i) {
    vec2 corner = clamp(first + 2.0 * vec2(i & 1, i >> 1), vec2(1.0), vec2(square.size - 1.0));
    vec2 at = (square.corner + corner) * 4.0 * shadow_texel_size();
    nearest = max(nearest, nearest_of(textureGather(shadow_pyramid, at, 1)));
    farthest = min(farthest, farthest_of(textureGather(shadow_pyramid, at, 0)));
  }
  return nearest;
}

float widest(TileInFace f, float nearest) { return clamp(f.scale * (nearest - f.farthest), 0.0, f.size); }

// How far from a pixel find_region looks when it knows of a penumbra this wide.
float footprint(float width) { return 4.0 * max(width, 2.0); }

// How far from a pixel the kernels of the filter reach whose region is at most this wide, in texels of mip 0; `coarse`: texels of mip 0 in
// those of the coarsest mip that they may use.
float kernels_reach(float width, out float coarse) {
  coarse = 1.0;
  if (kFilter == 0u) return 2.0;
  if (kFilter == 1u) return 0.5 * float(kKernel) + 2.0;
  if (kFilter == 2u) return 0.5 * max(width, float(kKernel)) + 2.0;
  coarse = power_of_two(ceil_log2(max(width / float(kKernel - 1), 1.0)));
  return (0.5 * float(kKernel) + 1.0) * coarse + 1.0;
}

// Whether nothing in a block of texels can be a blocker for any of the pixels. middle: of the block; half_side: from there to its outermost
// texels' middles.
bool is_harmless(TileInFace f, vec4 block, vec2 middle, float half_side, float coarse) {
  vec2 beyond = max(max(f.low - middle, middle - f.high), vec2(0.0));
  vec2 farthest_off = max(abs(middle - f.low), abs(middle - f.high)) + half_side;
  // Above the plane.
  vec2 steeper = abs(block.yz - f.plane.yz);
  float excess = block.x - (f.plane.x + dot(f.plane.yz, middle)) + (steeper.x + steeper.y) * half_side;
  bool below = excess + f.tilt * max(farthest_off.x, farthest_off.y) <= kPlaneMargin * f.least_bias;
  // In the cone; only the filter that has one knows it. See SearchCone: a texel of a mip may hold what lies half of it farther out.
  float off = max(beyond.x, beyond.y) - half_side - 0.5 - max(2.0 + 0.5 * coarse, coarse);
  bool outside = kFilter == 3u && block.w <= f.farthest + 2.0 * max(off, 0.0) / max(f.scale, 1e-6);
  return block.w <= 0.0 || below || outside;
}

bool all_harmless(TileInFace f, vec2 low, vec2 high, float coarse) {
  low = clamp(low, vec2(0.0), vec2(f.size - 1.0));
  high = clamp(high, vec2(0.0), vec2(f.size - 1.0));
  float side = float(GLOAM_SHADOW_PLANE_BLOCK);
  int level = 0;
  ivec2 first = ivec2(low / side), count = ivec2(high / side) - first + 1;
  for (int i = 1; i < GLOAM_SHADOW_PLANE_LEVELS; ++i) {
    bool more = max(count.x, count.y) > kMostBlocks;
    side = more ? 2.0 * side : side;
    level = more ? i : level;
    first = ivec2(low / side);
    count = ivec2(high / side) - first + 1;
  }
  if (max(count.x, count.y) > kMostBlocks || side > f.size) return false;
  MipSquare square = mip_square(f.origin / float(GLOAM_SHADOW_PLANE_BLOCK), f.size / float(GLOAM_SHADOW_PLANE_BLOCK), level,
                                shadow_block.atlas_size / float(GLOAM_SHADOW_PLANE_BLOCK));
  bool harmless = true;
  int i = 0;
  do {
    ivec2 block = first + ivec2(i % count.x, i / count.x);
    vec4 plane = texelFetch(shadow_planes, ivec2(square.corner) + block, 0);
    harmless = is_harmless(f, plane, (vec2(block) + 0.5) * side, 0.5 * side - 0.5, coarse);
  } while (harmless && ++i < count.x * count.y);
  return harmless;
}

bool leaves_face(TileInFace f, float reach) {
  return f.cube && (min(f.low.x, f.low.y) < reach || max(f.high.x, f.high.y) > f.size - reach);
}

uint classify_in_face(TileInFace f) {
  float farthest;
  float width = widest(f, nearest_in(f, vec2(0.0), vec2(f.size), farthest)), look = 0.0;
  for (int step = 0; step < 2; ++step) {
    look = footprint(width);
    width = widest(f, nearest_in(f, f.low - look, f.high + look, farthest));
  }
  float coarse;
  float reach = kernels_reach(width, coarse);
  // Filters that do not search for a region look at all that their kernel holds.
  look = max(look, reach);
  nearest_in(f, f.low - look, f.high + look, farthest);
  bool unlit = f.turned_away || farthest > f.nearest + f.most_bias + f.slope * max(0.5 * width + 2.0, reach);
  if (unlit) return f.surrounded ? kUnlit : kUnknown;
  if (!f.faces_light || leaves_face(f, reach)) return kUnknown;
  return all_harmless(f, f.low - reach, f.high + reach, coarse) ? kLit : kUnknown;
}

#include "shaders/shadows/classify_light.glsl"

#endif
