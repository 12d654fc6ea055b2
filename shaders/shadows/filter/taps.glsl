// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_TAPS_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_TAPS_GLSL

#include "shaders/shadows/filter/space.glsl"

// What all filters share: where the texels of a kernel lie, and what each is compared with. Texels of a gather are in
// the order (0,1), (1,1), (1,0), (0,0). A gather is named by the corner where its four texels meet.

// N × N texels round a receiver at one mip. Texel i of a row is at base + i; the middle of the kernel is the receiver
// itself: i = N/2 − 1 and N/2 are the texels left and right of it.
struct Kernel {
  MipSquare square;
  vec2 at;          // the receiver, texels of the mip from the face's corner
  vec2 base;        // the kernel's first texel
  vec2 fraction;    // of the way from texel N/2 − 1 to N/2
  vec2 slope;       // depth a texel of the mip
  float threshold;  // at the receiver
  float least;      // of any tap
};

// A texel of a mip may hold the nearest of a block, which may lie half a block nearer on the receiver's own plane:
// thresholds rise by that. Mean depths of one surface need it too where the plane is too steep to be one.
Kernel make_kernel(ShadowPoint p, int mip, int texels) {
  Kernel k;
  k.square = mip_square(p.origin, p.size, mip, shadow_block.atlas_size);
  k.at = p.at / k.square.texel;
  vec2 first = floor(k.at - 0.5);
  k.fraction = k.at - 0.5 - first;
  k.base = first - float(texels / 2 - 1);
  k.slope = p.slope * k.square.texel;
  float slope = slope_per_texel(p);
  k.threshold = p.threshold + 0.5 * (k.square.texel - 1.0) * slope;
  k.least = max(k.threshold - kRecedingTexels * k.square.texel * slope, p.least);
  return k;
}

// Corners of gathers stay where all four texels are the face's own.
float clamp_corner(Kernel k, float corner) { return clamp(corner, 1.0, k.square.size - 1.0); }

vec4 corner_slopes(Kernel k) {
  return 0.5 * vec4(k.slope.y - k.slope.x, k.slope.x + k.slope.y, k.slope.x - k.slope.y, -k.slope.x - k.slope.y);
}

vec4 gather_depth(Kernel k, vec2 corner) {
  return textureGather(shadow_atlas, (k.square.corner + corner) * shadow_texel_size());
}

// Thresholds of the four texels round a corner.
vec4 gather_threshold(Kernel k, vec2 corner, float least) {
  return max(vec4(k.threshold + dot(k.slope, corner - k.at)) + corner_slopes(k), vec4(least));
}

// The sixteen gathers of an 8×8 kernel.
struct Gathers8 {
  vec4 u;       // texture coordinates of the four columns
  vec4 v;       // of the four rows
  vec4 column;  // what columns and rows add up to is the plane's threshold at a corner
  vec4 row;
  vec4 corner;  // what the four texels round it differ by
};

Gathers8 make_gathers(Kernel k) {
  vec4 offsets = vec4(1.0, 3.0, 5.0, 7.0);
  vec4 x = clamp(k.base.x + offsets, 1.0, k.square.size - 1.0);
  vec4 y = clamp(k.base.y + offsets, 1.0, k.square.size - 1.0);
  vec2 texel = shadow_texel_size();
  return Gathers8((k.square.corner.x + x) * texel.x, (k.square.corner.y + y) * texel.y, k.slope.x * (x - k.at.x),
                  k.threshold + k.slope.y * (y - k.at.y), corner_slopes(k));
}

// Whether depths are above all: comparisons are cheaper than what max does for numbers that are none.
bvec4 is_nearer(vec4 depth, vec4 threshold, float least) {
  return bvec4(depth.x > threshold.x && depth.x > least, depth.y > threshold.y && depth.y > least,
               depth.z > threshold.z && depth.z > least, depth.w > threshold.w && depth.w > least);
}

bvec4 is_nearer(vec4 depth, vec4 threshold, vec4 a, vec4 b) {
  return bvec4(
      depth.x > threshold.x && depth.x > a.x && depth.x > b.x, depth.y > threshold.y && depth.y > a.y && depth.y > b.y,
      depth.z > threshold.z && depth.z > a.z && depth.z > b.z, depth.w > threshold.w && depth.w > a.w && depth.w > b.w);
}

// Threshold at a texel coordinate of mip 0.
float tap_threshold(ShadowPoint p, Kernel k, vec2 at, float least) {
  return max(k.threshold + dot(p.slope, at - p.at), least);
}

// The same for a texel of another face of a cube, on which the plane may lie more steeply.
float tap_threshold(ShadowPoint p, Kernel k, vec2 at, float least, float rise) {
  return tap_threshold(p, k, at, least) + max(rise - (k.threshold - p.threshold), 0.0);
}

// Whether a kernel that reaches this many texels of mip 0 needs other faces of a cube.
bool leaves_cube_face(ShadowPoint p, float reach) {
#ifndef GLOAM_SHADOWS_CROSSING
  return false;
#endif
  vec2 off = abs(p.at - 0.5 * p.size);
  return (kKinds & GLOAM_SHADOWS_CUBES) != 0u && p.face >= 0 && max(off.x, off.y) + reach > 0.5 * p.size;
}

// How far a kernel reaches, texels of mip 0.
float kernel_reach(int mip, int texels) { return float(texels / 2) * power_of_two(mip); }

// The coarsest mip a kernel may use: it is not wider than the face.
int coarsest_mip(ShadowPoint p, int texels) {
  return kMips == 0u ? 0 : max(floor_log2(p.size) - ceil_log2(float(texels)), 0);
}

// Share of texel i of N in a kernel with bilinear edges: they add up to N − 1.
vec2 edge_shares(vec2 fraction, vec2 i, float texels) {
  return clamp(i + 1.0 - fraction, 0.0, 1.0) * clamp(texels - 1.0 - i + fraction, 0.0, 1.0);
}

// One texel of mip 0; `at` becomes its centre.
float tap_depth(ShadowPoint p, inout vec2 at, bool across) {
  float rise, share;
  if (across) return cube_depth(p, at, 0, rise, share);
  vec2 cell = clamp(floor(at), vec2(0.0), vec2(p.size - 1.0));
  at = cell + 0.5;
  return texelFetch(shadow_atlas, ivec2(p.origin + cell), 0).x;
}

#endif
