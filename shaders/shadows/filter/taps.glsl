// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_TAPS_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_TAPS_GLSL

#include "shaders/shadows/filter/space.glsl"

// Shared by all filters: the texels of a kernel and the threshold of each tap. A gather returns its texels in the order
// (0,1), (1,1), (1,0), (0,0); it is addressed by the corner where they meet.

// N × N texels around a receiver at one mip. Texel i of a row is at base + i; the receiver lies between the middles of
// texels N/2 − 1 and N/2.
struct Kernel {
  MipSquare square;
  vec2 at;          // the receiver, in texels of the mip from the face's corner
  vec2 base;        // the kernel's first texel
  vec2 fraction;    // position of the receiver between the middles of texels N/2 − 1 (0) and N/2 (1)
  vec2 slope;       // depth per texel of the mip, on the receiver plane
  float threshold;  // threshold at the receiver
  float least;      // least threshold of any tap
};

// A texel of a mip may hold the nearest depth of its block. Half a block away from the block's middle, the receiver
// plane itself may be nearer to the light, so thresholds are raised by its slope over half a block. Coverage mips need
// that too where the receiver plane is steeper than their limit for one surface.
Kernel make_kernel(ShadowPoint p, int mip, int texels) {
  Kernel k;
  k.square = mip_square(p.origin, p.size, mip, shadow_block.atlas_size);
  k.at = p.at / k.square.texel;
  vec2 first = floor(k.at - 0.5);
  k.fraction = k.at - 0.5 - first;
  k.base = first - float(texels / 2 - 1);
  k.slope = p.slope * k.square.texel;
  float slope = slope_per_texel(p);
  precise float threshold = p.threshold + 0.5 * (k.square.texel - 1.0) * slope;
  precise float least = threshold - kRecedingTexels * k.square.texel * slope;
  k.threshold = threshold;
  k.least = max(least, p.least);
  return k;
}

// Clamps a gather's corner so that all four texels belong to the face.
float clamp_corner(Kernel k, float corner) { return clamp(corner, 1.0, k.square.size - 1.0); }

// Depths of the receiver plane at a gather's four texels, relative to its corner.
vec4 corner_slopes(Kernel k) {
  return 0.5 * vec4(k.slope.y - k.slope.x, k.slope.x + k.slope.y, k.slope.x - k.slope.y, -k.slope.x - k.slope.y);
}

vec4 gather_depth(Kernel k, vec2 corner) {
  return textureGather(shadow_atlas, (k.square.corner + corner) * shadow_texel_size());
}

// Thresholds of the four texels around a corner.
vec4 gather_threshold(Kernel k, vec2 corner, float least) {
  precise vec4 threshold = vec4(k.threshold + dot(k.slope, corner - k.at)) + corner_slopes(k);
  return max(threshold, vec4(least));
}

// The sixteen gathers of an 8×8 kernel.
struct Gathers8 {
  vec4 u;       // texture coordinates of the four gather columns
  vec4 v;       // texture coordinates of the four gather rows
  vec4 column;  // column + row is the threshold at a gather's corner
  vec4 row;
  vec4 corner;  // differences of the four texels' thresholds from that
};

Gathers8 make_gathers(Kernel k) {
  vec4 offsets = vec4(1.0, 3.0, 5.0, 7.0);
  vec4 x = clamp(k.base.x + offsets, 1.0, k.square.size - 1.0);
  vec4 y = clamp(k.base.y + offsets, 1.0, k.square.size - 1.0);
  vec2 texel = shadow_texel_size();
  precise vec4 column = k.slope.x * (x - k.at.x), row = k.threshold + k.slope.y * (y - k.at.y);
  return Gathers8((k.square.corner.x + x) * texel.x, (k.square.corner.y + y) * texel.y, column, row, corner_slopes(k));
}

// Whether each depth is above its threshold and above all other bounds. Comparisons cost less than max(), which has to
// handle NaN.
bvec4 is_nearer(vec4 depth, vec4 threshold, float least) {
  return bvec4(depth.x > threshold.x && depth.x > least, depth.y > threshold.y && depth.y > least,
               depth.z > threshold.z && depth.z > least, depth.w > threshold.w && depth.w > least);
}

bvec4 is_nearer(vec4 depth, vec4 threshold, vec4 a, vec4 b) {
  return bvec4(
      depth.x > threshold.x && depth.x > a.x && depth.x > b.x, depth.y > threshold.y && depth.y > a.y && depth.y > b.y,
      depth.z > threshold.z && depth.z > a.z && depth.z > b.z, depth.w > threshold.w && depth.w > a.w && depth.w > b.w);
}

// Threshold of a tap at a texel coordinate of mip 0.
float tap_threshold(ShadowPoint p, Kernel k, vec2 at, float least) {
  precise float threshold = k.threshold + dot(p.slope, at - p.at);
  return max(threshold, least);
}

// The same for a texel of another cube face, in which the receiver plane may be steeper. rise: result of cube_depth().
float tap_threshold(ShadowPoint p, Kernel k, vec2 at, float least, float rise) {
  return tap_threshold(p, k, at, least) + max(rise - (k.threshold - p.threshold), 0.0);
}

// Whether a kernel that reaches this many texels of mip 0 from the receiver needs other cube faces.
bool leaves_cube_face(ShadowPoint p, float reach) {
#ifndef GLOAM_SHADOWS_CROSSING
  return false;
#endif
  vec2 off = abs(p.at - 0.5 * p.size);
  return (kKinds & GLOAM_SHADOWS_CUBES) != 0u && p.face >= 0 && max(off.x, off.y) + reach > 0.5 * p.size;
}

// Reach of a kernel from the receiver, in texels of mip 0.
float kernel_reach(int mip, int texels) { return float(texels / 2) * power_of_two(mip); }

// The coarsest mip that a kernel may use: the last one in which the kernel is not wider than the face.
int coarsest_mip(ShadowPoint p, int texels) {
  return kMips == 0u ? 0 : max(floor_log2(p.size) - ceil_log2(float(texels)), 0);
}

// Weights of texel i of N in a kernel with bilinear edges, by axis; those of a row sum to N − 1.
vec2 edge_shares(vec2 fraction, vec2 i, float texels) {
  return clamp(i + 1.0 - fraction, 0.0, 1.0) * clamp(texels - 1.0 - i + fraction, 0.0, 1.0);
}

// Depth of the texel of mip 0 at `at`. `at` is moved to the texel's centre. across: the texel may be in another cube
// face.
float tap_depth(ShadowPoint p, inout vec2 at, bool across) {
  float rise, share;
  if (across) return cube_depth(p, at, 0, rise, share);
  vec2 cell = clamp(floor(at), vec2(0.0), vec2(p.size - 1.0));
  at = cell + 0.5;
  return texelFetch(shadow_atlas, ivec2(p.origin + cell), 0).x;
}

#endif
