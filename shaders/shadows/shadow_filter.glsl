// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_FILTER_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_FILTER_GLSL

#include "shaders/shadows/blocker_search.glsl"
#include "shaders/shadows/filter_kernels.glsl"

// Contact-hardening filter (Thief §1.3.3): two mips, in each of which the penumbra is 4 to 8 and 2 to 4 texels wide.

// Two texel rows, x-interpolated and folded about the middle column: y is the sum of the cells one column left and right of it and so on.
void gather_rows(Kernel k, vec4 corner_x, float corner_y, out vec4 upper, out vec4 lower) {
  vec4 slopes = corner_slopes(k);
  vec4 plane = k.threshold + k.slope.x * (corner_x - k.at.x) + k.slope.y * (corner_y - k.at.y);
  vec4 b0 = vec4(greaterThan(gather_depth(k, vec2(corner_x.x, corner_y)), max(plane.x + slopes, vec4(k.least))));
  vec4 b1 = vec4(greaterThan(gather_depth(k, vec2(corner_x.y, corner_y)), max(plane.y + slopes, vec4(k.least))));
  vec4 b2 = vec4(greaterThan(gather_depth(k, vec2(corner_x.z, corner_y)), max(plane.z + slopes, vec4(k.least))));
  vec4 b3 = vec4(greaterThan(gather_depth(k, vec2(corner_x.w, corner_y)), max(plane.w + slopes, vec4(k.least))));
  upper = mix(vec4(b1.z, b1.w + b2.w, b0.z + b2.z, b0.w + b3.w), vec4(b2.w, b1.z + b2.z, b1.w + b3.w, b0.z + b3.z), k.fraction.x);
  lower = mix(vec4(b1.y, b1.x + b2.x, b0.y + b2.y, b0.x + b3.x), vec4(b2.x, b1.y + b2.y, b1.x + b3.x, b0.y + b3.y), k.fraction.x);
}

// Blocked share under the 8×8 kernel. Rows come in pairs that mirror each other about the middle, from the outside in.
float blocked_share_8(ShadowPoint p, int mip, float width) {
  Kernel k = make_kernel(p, mip, 8);
  FilterRows rows = filter_rows(clamp(width / (8.0 * k.square.texel), 0.0, 1.0), kKernelShape != 0u);
  vec4 offsets = vec4(1.0, 3.0, 5.0, 7.0);
  vec4 corner_x = clamp(k.base.x + offsets, 1.0, k.square.size - 1.0);
  vec4 corner_y = clamp(k.base.y + offsets, 1.0, k.square.size - 1.0);
  vec4 outside = vec4(0.0), middle = rows.row3, inside = rows.row2, sum = vec4(0.0);
  for (int turn = 0; turn < 2; ++turn) {
    vec4 upper, lower;
    vec4 first_near = mix(outside, middle, 1.0 - k.fraction.y), first_far = mix(outside, middle, k.fraction.y);
    vec4 second_near = mix(middle, inside, 1.0 - k.fraction.y), second_far = mix(middle, inside, k.fraction.y);
    gather_rows(k, corner_x, turn == 0 ? corner_y.x : corner_y.y, upper, lower);
    sum += upper * first_near + lower * second_near;
    gather_rows(k, corner_x, turn == 0 ? corner_y.w : corner_y.z, upper, lower);
    sum += upper * second_far + lower * first_far;
    outside = rows.row2;
    middle = rows.row1;
    inside = rows.row0;
  }
  return dot(sum, vec4(1.0));
}

// Share of a texel that a disc or square covers, by the distance of their middles. All in texels.
vec4 covered(float radius, vec4 x, vec4 y) {
  if (kKernelShape != 0u) return clamp(radius + 0.5 - abs(x), 0.0, 1.0) * clamp(radius + 0.5 - abs(y), 0.0, 1.0);
  return clamp(radius + 0.5 - sqrt(x * x + y * y), 0.0, 1.0);
}

// Radius of a kernel in texels of its mip. From half a texel, below which it would miss all texels, to what N texels hold.
float covering_radius(Kernel k, float width, int texels) {
  return clamp(0.5 * width / k.square.texel, 0.5, 0.5 * float(texels - 1));
}

// Blocked share under N × N texels, each weighted by what the disc (or square) covers of it.
float blocked_share_any(ShadowPoint p, int mip, float width, int texels) {
  Kernel k = make_kernel(p, mip, texels);
  float radius = covering_radius(k, width, texels);
  vec4 all = vec4(0.0), blocked = vec4(0.0);
  for (int y = 1; y < texels; y += 2) {
    for (int x = 1; x < texels; x += 2) {
      vec2 corner = k.base + vec2(x, y);
      vec2 off = corner - k.at;
      vec4 weight = covered(radius, off.x + vec4(-0.5, 0.5, 0.5, -0.5), off.y + vec4(0.5, 0.5, -0.5, -0.5));
      corner = clamp(corner, vec2(1.0), vec2(k.square.size - 1.0));
      all += weight;
      blocked += weight * vec4(greaterThan(gather_depth(k, corner), gather_threshold(k, corner, k.least)));
    }
  }
  return dot(blocked, vec4(1.0)) / dot(all, vec4(1.0));
}

// The same where other faces of a cube have part in it: texel by texel.
float blocked_share_across(ShadowPoint p, int mip, float width, int texels) {
  Kernel k = make_kernel(p, mip, texels);
  float radius = covering_radius(k, width, texels);
  float all = 0.0, blocked = 0.0;
  for (int i = 0; i < texels * texels; ++i) {
    vec2 cell = k.base + vec2(i % texels, i / texels) + 0.5;
    float weight = covered(radius, vec4(cell.x - k.at.x), vec4(cell.y - k.at.y)).x;
    vec2 at = cell * k.square.texel;
    float rise;
    float depth = cube_depth(p, at, mip, rise);
    all += weight;
    blocked += depth > tap_threshold(p, k, at, k.least, rise) ? weight : 0.0;
  }
  return blocked / all;
}

float blocked_share(ShadowPoint p, int mip, float width) {
  float share = 0.0;
  bool across = leaves_cube_face(p, kernel_reach(mip, kKernel));
  if (!across) do {
    share = kKernel == 8 ? blocked_share_8(p, mip, width) : blocked_share_any(p, mip, width, kKernel);
  } while (never(p));
  if (across) do {
    share = blocked_share_across(p, mip, width, kKernel);
  } while (never(p));
  return share;
}

// Visibility under a penumbra of this width, texels of mip 0.
float filtered_visibility(ShadowPoint p, float width) {
  int last = coarsest_mip(p, kKernel);
  float level = max(2.0 * width / float(kKernel), 1.0);  // the penumbra is half as wide as the kernel in mip log2(level)
  int fine = min(floor_log2(level), last);
  float blend = fine < last ? clamp(log2(level * power_of_two(-fine)), 0.0, 1.0) : 0.0;
  float share = 0.0;
  int turns = blend > 0.0 || kFullPenumbra != 0u ? 2 : 1;
  int turn = 0;
  do {
    float part = turn == 0 ? 1.0 - blend : blend;
    share += part * blocked_share(p, min(fine + turn, last), width);
  } while (++turn < turns);
  return 1.0 - share;
}

float chs_visibility(ShadowPoint p) {
  SearchRegion region = SearchRegion(0.0, 0.0, 0.0);
  if (p.live) do {
    region = find_region(p);
  } while (never(p));
  float reach = slope_per_texel(p) * (0.5 * region.width + 2.0);
  bool unlit = region.farthest > p.threshold + reach && kFullPenumbra == 0u;
  bool unsure = region.nearest > p.threshold || kFullPenumbra != 0u;
  float visibility = unlit && p.live ? 0.0 : 1.0;
  if (p.live && unsure && !unlit) do {
    int mip = clamp(ceil_log2(max(region.width / float(kKernel - 1), 1.0)), 0, coarsest_mip(p, kKernel));
    Blockers blockers = box_blockers(p, mip, kKernel, false);
    float width = penumbra_width(p, blockers.depth);
    if (blockers.count > 1e-3 || kFullPenumbra != 0u) do {
      visibility = filtered_visibility(p, width);
    } while (never(p));
  } while (never(p));
  return visibility;
}

#endif
