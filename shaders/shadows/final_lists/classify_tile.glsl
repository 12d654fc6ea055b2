// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_CLASSIFY_TILE_GLSL
#define GLOAM_SHADERS_SHADOWS_CLASSIFY_TILE_GLSL

#include "shaders/shadows/maps/planes_shared.h"
#include "shaders/shadows/shadows_api.glsl"
#include "shaders/shadows/final_lists/tile_bounds.glsl"

// Classification: a verdict on a whole tile and one light from shadow maps, before any filtering. Conservative: the
// verdict is lit or unlit only if the filter of every pixel of the tile would find that, for any filter. All bounds
// here enclose the values of the pixels, with a margin for rounding.
//
// Lit: in the part of the map that the pixels' kernels may reach, every block of texels is below the pixels' planes, or
// so far to the side that it is outside the cone between pixel and emitter. Blocks are compared with planes and not
// with depths: beside the tile, a surface that slants toward the light is nearer to the light than inside the tile.
// Unlit: the farthest texel of that part is nearer to the light than all pixels.
//
// Before including this, define GLOAM_SHADOW_PLANES_BINDING.

layout(set = 0, binding = GLOAM_SHADOW_PLANES_BINDING) uniform sampler2D shadow_planes;

const uint kUnknown = 0u;
const uint kLit = 1u;
const uint kUnlit = 2u;
const uint kCastsNone = 3u;
const uint kNotAsked = 4u;  // no pixel asks: the light would illuminate none of them without shadows

// The verdict of two groups of pixels, or of one group in two faces.
uint agreed(uint a, uint b) { return a == kNotAsked || a == b ? b : b == kNotAsked ? a : kUnknown; }

const int kMostBlocks = 4;        // most blocks along a side of the tested area, at its coarsest level
const float kPlaneMargin = 0.75;  // share of the bias that a block may exceed the pixels' planes by

// Bounds of a tile's pixels in one face, in texels and depths.
struct TileInFace {
  vec2 origin;  // corner of the face in the atlas, texels of mip 0
  float size;
  vec2 low, high;  // bounds of the pixels, texels of mip 0
  float farthest;  // least and greatest depth of the pixels
  float nearest;
  vec3 plane;   // depth at texel (0, 0), slope per texel to the right and down; below the planes of all pixels, except
                // for `tilt`
  float tilt;   // how far a pixel's plane may be below `plane`, per texel of distance from the pixel
  float slope;  // greatest slope_per_texel of the pixels
  float scale;  // greatest ShadowPoint::scale of the pixels
  float least_bias;  // least and greatest bias of the pixels, depth
  float most_bias;
  bool cube;         // kernels that leave the face continue in others
  float near_width;  // wider search regions may be judged by near_visibility()
  mat2 sides;        // columns: normals of the tile's two sides, in texels of mip 0, scaled to |x| + |y| = 1
  vec4 side_ranges;  // least and greatest dot product of the pixels with the first, then with the second
  bool surrounded;   // all pixels use this face
  bool clear;        // all pixels are beyond the near planes of a local light
  bool faces_light;  // the whole emitter is above the surface of each pixel
  bool turned_away;  // the whole emitter is below the surface of each pixel
};

// Sets the bounds in texels. corners: of the tile, in texels of mip 0; corners[i] and corners[i + 4] are on the same
// view ray. slack: margin in texels.
void set_texels(vec2 corners[8], float slack, inout TileInFace f) {
  f.low = f.high = corners[0];
  for (int i = 1; i < 8; ++i) {
    f.low = min(f.low, corners[i]);
    f.high = max(f.high, corners[i]);
  }
  f.low -= slack;
  f.high += slack;
  // If the camera sees the tile at a grazing angle, its pixels lie along a diagonal of that box: bound them by the
  // tile's sides as well.
  vec2 right = corners[1] + corners[3] - corners[0] - corners[2],
       down = corners[2] + corners[3] - corners[0] - corners[1];
  vec2 first = vec2(-right.y, right.x) / max(abs(right.x) + abs(right.y), 1e-9);
  vec2 second = vec2(-down.y, down.x) / max(abs(down.x) + abs(down.y), 1e-9);
  f.sides = mat2(first, second);
  vec2 least = corners[0] * f.sides, most = least;
  for (int i = 1; i < 8; ++i) {
    vec2 along = corners[i] * f.sides;
    least = min(least, along);
    most = max(most, along);
  }
  f.side_ranges = vec4(least.x, most.x, least.y, most.y) + slack * vec4(-1.0, 1.0, -1.0, 1.0);
}

float nearest_in(TileInFace f, vec2 low, vec2 high, out float farthest) {
  return nearest_in_face(f.origin, f.size, low, high, farthest);
}

float widest(TileInFace f, float nearest) { return clamp(f.scale * (nearest - f.farthest), 0.0, f.size); }

// Distance from a pixel, in texels of mip 0, up to which find_region() reads the pyramid for a penumbra of this width.
float footprint(float width) { return 4.0 * max(width, 2.0); }

// Nearest depth among texels of the pyramid that the cone of a pixel may meet; the bound on nearest_in_cone() of the
// pixels. width: of their search regions, so far.
float nearest_in_cones(TileInFace f, float width) {
  const float margin = 2.0;  // as in nearest_in_cone()
  vec2 low = clamp(f.low - 0.5 * width - margin, vec2(0.0), vec2(f.size)) * 0.25;
  vec2 high = clamp(f.high + 0.5 * width + margin, vec2(0.0), vec2(f.size)) * 0.25;
  int last = floor_log2(f.size) - GLOAM_SHADOW_PYRAMID_MIP - 1;
  int level = clamp(ceil_log2(max(max(high.x - low.x, high.y - low.y) / 3.0, 1.0)), 0, last);
  MipSquare square = mip_square(f.origin * 0.25, f.size * 0.25, level, shadow_block.atlas_size * 0.25);
  float texel = 4.0 * square.texel, a_texel = 2.0 / max(f.scale, 1e-6);
  vec2 first = floor(low / square.texel) + 1.0;
  float nearest = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 corner = clamp(first + 2.0 * vec2(i & 1, i >> 1), vec2(1.0), vec2(square.size - 1.0));
    vec4 depth = textureGather(shadow_pyramid, (square.corner + corner) * shadow_texel_size() * vec2(4.0, 2.0));
    vec2 from_low = f.low - corner * texel, from_high = corner * texel - f.high;
    vec2 before = max(from_low, from_high - texel),
         after = max(from_low - texel, from_high);  // left, upper; right, lower
    vec2 least_before = f.farthest + a_texel * max(before - margin, 0.0);
    vec2 least_after = f.farthest + a_texel * max(after - margin, 0.0);
    vec4 columns = vec4(least_before.x, least_after.x, least_after.x, least_before.x);
    vec4 rows = vec4(least_after.y, least_after.y, least_before.y, least_before.y);
    nearest = max(nearest, nearest_of(mix(vec4(0.0), depth, greaterThan(depth, max(columns, rows)))));
  }
  return nearest;
}

// Whether pixels read texels of the face when they look this far beyond the tile.
bool touches_face(TileInFace f, float look) {
  return all(greaterThan(f.high + look, vec2(0.0))) && all(lessThan(f.low - look, vec2(f.size)));
}

// Reach of the filter's kernels from a pixel, in texels of mip 0, for search regions up to this width. coarse: texels
// of mip 0 per texel of the coarsest mip that they may use.
float kernels_reach(float width, out float coarse) {
  coarse = 1.0;
  if (kFilter == 0u) return 2.0;
  if (kFilter == 1u) return 0.5 * float(kKernel) + 2.0;
  if (kFilter == 2u) return 0.5 * max(width, float(kKernel)) + 2.0;
  coarse = power_of_two(ceil_log2(max(width / float(kKernel - 1), 1.0)));
  return (0.5 * float(kKernel) + 1.0) * coarse + 1.0;
}

// The part of a face that the tile's pixels may read.
struct Looks {
  vec2 low, high;  // bounds, texels of mip 0
  float reach;     // reach of kernels beyond the tile
  float slack;     // margin of the cone in texels: a blocker may be stored up to this much farther out
};

// Whether no texel of a block can be a blocker for any of the pixels. block: a texel of the planes. middle: of the
// block, texels of mip 0. half_side: texels from there to the middles of the block's outermost texels.
bool is_harmless(TileInFace f, Looks looks, vec4 block, vec2 middle, float half_side) {
  vec2 beyond = max(max(f.low - middle, middle - f.high) - half_side, vec2(0.0));
  vec2 farthest_off = max(abs(middle - f.low), abs(middle - f.high)) + half_side;
  vec2 along = middle * f.sides;
  vec2 aside = max(f.side_ranges.xz - along, along - f.side_ranges.yw) - half_side;
  float off = max(max(beyond.x, beyond.y), max(aside.x, aside.y));
  vec2 steeper = abs(block.yz - f.plane.yz);
  float excess = block.x - (f.plane.x + dot(f.plane.yz, middle)) + (steeper.x + steeper.y) * half_side;
  bool below = excess + f.tilt * max(farthest_off.x, farthest_off.y) <= kPlaneMargin * f.least_bias;
  // Only filter chs has a cone. The block is outside the cone if it is outside the cone of the farthest pixel; or,
  // where the cone rises faster than the plane falls, if it is outside the cones of all pixels on or above the plane.
  float cone_slope = 2.0 / max(f.scale, 1e-6), rise = cone_slope - abs(f.plane.y) - abs(f.plane.z);
  bool outside = block.w <= f.farthest + cone_slope * max(off - looks.slack, 0.0) ||
                 (rise > 0.0 && excess <= rise * off - cone_slope * looks.slack);
  return block.w <= 0.0 || below || off > looks.reach || (kFilter == 3u && outside);
}

// The same for one texel.
bool is_harmless(TileInFace f, Looks looks, float depth, vec2 middle) {
  return is_harmless(f, looks, vec4(depth, f.plane.yz, depth), middle, 0.0);
}

// A stack of blocks of level 0 that are tested texel by texel, one byte per coordinate. The newest is in the low 16
// bits of blocks.x. The stack has room for more than kMostCloseBlocks, so that the block that exceeds the limit can be
// pushed.
struct CloseBlocks {
  uvec4 blocks;
  int count;
};

const int kMostCloseBlocks = 4;

void push(inout CloseBlocks c, uvec2 block) {
  c.blocks = c.blocks << 16 | uvec4(block.x & 255u | (block.y & 255u) << 8, c.blocks.xyz >> 16);
  ++c.count;
}

ivec2 newest(CloseBlocks c) { return ivec2(c.blocks.x & 255u, c.blocks.x >> 8 & 255u); }

void pop(inout CloseBlocks c) {
  c.blocks = c.blocks >> 16 | uvec4(c.blocks.yzw, 0u) << 16;
  --c.count;
}

bool block_is_harmless(TileInFace f, Looks looks, ivec2 block, int level) {
  float side = float(GLOAM_SHADOW_PLANE_BLOCK << level);
  const float per_block = 1.0 / float(GLOAM_SHADOW_PLANE_BLOCK);
  MipSquare square = mip_square(f.origin * per_block, f.size * per_block, level, shadow_block.atlas_size * per_block);
  vec4 plane = texelFetch(shadow_planes, ivec2(square.corner) + block, 0);
  return is_harmless(f, looks, plane, (vec2(block) + 0.5) * side, 0.5 * side - 0.5);
}

// Whether four texels of a block of level 0 are harmless. quad: 0 … 15, row by row.
bool quad_is_harmless(TileInFace f, Looks looks, ivec2 block, int quad) {
  vec2 corner = vec2(block) * float(GLOAM_SHADOW_PLANE_BLOCK) + 2.0 * vec2(quad % 4, quad / 4) + 1.0;
  vec4 depths = textureGather(shadow_atlas, (f.origin + corner) * shadow_texel_size());
  return is_harmless(f, looks, depths.x, corner + vec2(-0.5, 0.5)) &&
         is_harmless(f, looks, depths.y, corner + vec2(0.5, 0.5)) &&
         is_harmless(f, looks, depths.z, corner + vec2(0.5, -0.5)) &&
         is_harmless(f, looks, depths.w, corner + vec2(-0.5, -0.5));
}

// Tests blocks from coarse to fine, descending only where a block may hold a blocker. Blocks of level 0 that may hold
// one are returned in `close`, relative to `low`. Returns false if there are more than kMostCloseBlocks, or if the test
// is not finished after most_turns iterations.
bool blocks_harmless(TileInFace f, ivec2 low, ivec2 high, Looks looks, int most_turns, out CloseBlocks close) {
  close = CloseBlocks(uvec4(0u), 0);
  int top = 0;
  for (int i = 1; i < GLOAM_SHADOW_PLANE_LEVELS; ++i)
    top = max((high.x >> top) - (low.x >> top), (high.y >> top) - (low.y >> top)) >= kMostBlocks ? i : top;
  ivec2 first = low >> top, count = (high >> top) - first + 1;
  if (max(count.x, count.y) > kMostBlocks || float(GLOAM_SHADOW_PLANE_BLOCK << top) > f.size) return false;
  ivec2 block = first;
  int level = top, done = 0, turn = 0;
  bool up = false;
  do {
    bool fine = up || block_is_harmless(f, looks, block, level);
    bool closer = !fine && level == 0;
    if (closer) push(close, uvec2(block - low));
    if (!fine && !closer) {
      --level;
      block *= 2;
      continue;
    }
    // Go to the next of the four blocks that form a block of the coarser level. After the fourth, the coarser block is
    // done.
    ivec2 child = block & 1;
    bool at_top = level == top;
    done += int(at_top);
    up = !at_top && child == ivec2(1);
    block = at_top ? first + ivec2(done % count.x, done / count.x)
            : up   ? block >> 1
                   : block + ivec2(child.x == 0 ? 1 : -1, child.x);
    level += int(up);
  } while (++turn < most_turns && done < count.x * count.y && close.count <= kMostCloseBlocks);
  return done == count.x * count.y && close.count <= kMostCloseBlocks;
}

bool all_harmless(TileInFace f, Looks looks, int most_turns) {
  ivec2 low = ivec2(clamp(looks.low, vec2(0.0), vec2(f.size - 1.0))) / GLOAM_SHADOW_PLANE_BLOCK;
  ivec2 high = ivec2(clamp(looks.high, vec2(0.0), vec2(f.size - 1.0))) / GLOAM_SHADOW_PLANE_BLOCK;
  CloseBlocks close;
  bool harmless = blocks_harmless(f, low, high, looks, most_turns, close);
  int quad = 0;
  const int quads = GLOAM_SHADOW_PLANE_BLOCK * GLOAM_SHADOW_PLANE_BLOCK / 4;
  if (harmless && close.count > 0) do {
      harmless = quad_is_harmless(f, looks, low + newest(close), quad);
      quad = (quad + 1) % quads;
      if (quad == 0) pop(close);
    } while (harmless && close.count > 0);
  return harmless && close.count == 0;  // count > 0 if the device ended the loop early: not all blocks were tested
}

bool reaches_border(TileInFace f, float reach) {
  return min(f.low.x, f.low.y) < reach || max(f.high.x, f.high.y) > f.size - reach;
}

bool leaves_face(TileInFace f, float reach) { return f.cube && reaches_border(f, reach); }

// Greatest width of the pixels' search regions as far as this face decides it: as find_region() does. clear: no pixel
// finds a blocker in its region.
float widest_region(TileInFace f, out bool clear) {
  int last = floor_log2(f.size) - GLOAM_SHADOW_PYRAMID_MIP - 1;
  MipSquare square = mip_square(f.origin * 0.25, f.size * 0.25, last, shadow_block.atlas_size * 0.25);
  float of_face = gather_nearest(square.corner + 1.0), farthest;
  float width = widest(f, of_face), look = footprint(width);
  width = min(width, widest(f, nearest_in(f, f.low - look, f.high + look, farthest)));
#ifdef GLOAM_CLASSIFY_SUNS
  const bool orthographic = true;
#else
  const bool orthographic = false;
#endif
  int step = 0, steps = cone_steps(orthographic, of_face, f.nearest);
  float nearest;
  do {
    nearest = nearest_in_cones(f, width);
    width = min(width, widest(f, nearest));
  } while (++step < steps);
  clear = kFilter == 3u && nearest < f.farthest + kPlaneMargin * f.least_bias;
  return width;
}

// Classifies the tile in one face. width: greatest width of the pixels' search regions. stretch: a texel in the face of
// a pixel is at most this many texels wide here. whole: all pixels use this face, or other faces that are classified,
// too. clear: of widest_region().
uint classify_in_face(TileInFace f, int most_turns, float width, float stretch, bool whole, bool clear) {
  float farthest, coarse;
  float reach = kernels_reach(width, coarse) * stretch;
  nearest_in(f, f.low - reach, f.high + reach, farthest);
  bool hidden = farthest > f.nearest + f.most_bias + f.slope * max((0.5 * width + 2.0) * stretch, reach);
  // near_visibility() finds no blocker outside a spot's map.
  bool open = !f.cube && width > f.near_width && reaches_border(f, width + 2.0);
  bool unlit = f.turned_away || (hidden && !open);
  if (unlit) return whole ? kUnlit : kUnknown;
  if (!f.faces_light || most_turns == 0) return kUnknown;
  // Reasons for the slack: a texel of a mip may hold a depth from half a texel farther out, and a SearchCone begins to
  // rise only at its reach.
  if (clear) return kLit;
  Looks looks = Looks(f.low - reach, f.high + reach, reach, stretch * max(2.0 + 0.5 * coarse, coarse));
  return all_harmless(f, looks, most_turns) ? kLit : kUnknown;
}

#include "shaders/shadows/final_lists/classify_light.glsl"

#endif
