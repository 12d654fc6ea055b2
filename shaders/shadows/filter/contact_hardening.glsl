// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_FILTER_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_FILTER_GLSL

#include "shaders/shadows/filter/blocker_search.glsl"
#include "shaders/shadows/filter/kernels.glsl"
#include "shaders/shadows/filter/near_blockers.glsl"

// The contact-hardening filter (Thief §1.3.3). It blends two mips, in which the penumbra is 4 to 8 and 2 to 4 texels
// wide.

// A texel of the kernel hides a part of the emitter only if its surface lies in the cone between receiver and emitter
// (SearchCone). Without that test, a wall that meets the receiver's own in a corner would block in the kernel of any
// blocker farther away, because all of it is nearer to the light than the receiver plane. The cone here is twice as
// wide as the emitter: a surface that slants away from the light keeps blocking in all of its kernel, even where its
// depth falls by half of its distance from the receiver.
SearchCone kernel_cone(ShadowPoint p, Kernel k, float width) {
  SearchCone cone = make_cone(p, k, 0.5 * width / k.square.texel, false);
  return SearchCone(k.least, 0.5 * cone.depth_per_texel, cone.reach, k.least);
}

// Adds the blocked weights of one gather. rows: least depths of the cone in the lower and upper row; columns: in the
// left and right column. sums: blocked weight of the kernel whose middle is texel column 3 (x), and of
// the kernel whose middle is column 4 (y); the result is interpolated between both. at_3, at_4: weights of the four
// texels in the first and in the second kernel.
void add_gather(inout vec2 sums, vec2 at, float threshold, vec4 corner, vec2 rows, vec2 columns, vec4 at_3, vec4 at_4) {
  vec4 depth = textureGather(shadow_atlas, at);
  bvec4 blocked = is_nearer(depth, threshold + corner, rows.xxyy, columns.xyyx);
  vec4 share = coverage(depth);
  sums = blocked.x ? sums + share.x * vec2(at_3.x, at_4.x) : sums;
  sums = blocked.y ? sums + share.y * vec2(at_3.y, at_4.y) : sums;
  sums = blocked.z ? sums + share.z * vec2(at_3.z, at_4.z) : sums;
  sums = blocked.w ? sums + share.w * vec2(at_3.w, at_4.w) : sums;
}

// Four gathers side by side. rows: least depths of the lower and upper row; left, right: of the columns. upper, lower:
// weights of the upper and lower texel row, for the cells 0, 1, 2, 3 columns from the middle.
void add_gathers(inout vec2 sums, Gathers8 g, float v, float row, vec2 rows, vec4 left, vec4 right, vec4 upper,
                 vec4 lower) {
  add_gather(sums, vec2(g.u.x, v), g.column.x + row, g.corner, rows, vec2(left.x, right.x), vec4(lower.wz, upper.zw),
             vec4(0.0, lower.w, upper.w, 0.0));
  add_gather(sums, vec2(g.u.y, v), g.column.y + row, g.corner, rows, vec2(left.y, right.y), vec4(lower.yx, upper.xy),
             vec4(lower.zy, upper.yz));
  add_gather(sums, vec2(g.u.z, v), g.column.z + row, g.corner, rows, vec2(left.z, right.z), vec4(lower.yz, upper.zy),
             vec4(lower.xy, upper.yx));
  add_gather(sums, vec2(g.u.w, v), g.column.w + row, g.corner, rows, vec2(left.w, right.w),
             vec4(lower.w, 0.0, 0.0, upper.w), vec4(lower.zw, upper.wz));
}

// Blocked share of the 8×8 kernel. Gather rows come in pairs that mirror each other about the middle: the outer pair
// first.
float blocked_share_8(ShadowPoint p, int mip, float width) {
  Kernel k = make_kernel(p, mip, 8);
  Gathers8 g = make_gathers(k);
  FilterRows rows = filter_rows(clamp(width / (8.0 * k.square.texel), 0.0, 1.0), kKernelShape != 0u);
  ConeEdges8 e = cone_edges(kernel_cone(p, k, width), k);
  vec2 sums = vec2(0.0);
  float near = 1.0 - k.fraction.y, far = k.fraction.y;
  add_gathers(sums, g, g.v.x, g.row.x, vec2(e.lower.x, e.upper.x), e.left, e.right, rows.row3 * near,
              mix(rows.row3, rows.row2, near));
  add_gathers(sums, g, g.v.w, g.row.w, vec2(e.lower.w, e.upper.w), e.left, e.right, mix(rows.row3, rows.row2, far),
              rows.row3 * far);
  add_gathers(sums, g, g.v.y, g.row.y, vec2(e.lower.y, e.upper.y), e.left, e.right, mix(rows.row2, rows.row1, near),
              mix(rows.row1, rows.row0, near));
  add_gathers(sums, g, g.v.z, g.row.z, vec2(e.lower.z, e.upper.z), e.left, e.right, mix(rows.row1, rows.row0, far),
              mix(rows.row2, rows.row1, far));
  return mix(sums.x, sums.y, k.fraction.x);
}

// Share of a texel that the disc (or square) covers, from the offset between their middles. All in texels.
vec4 covered(float radius, vec4 x, vec4 y) {
  if (kKernelShape != 0u) return clamp(radius + 0.5 - abs(x), 0.0, 1.0) * clamp(radius + 0.5 - abs(y), 0.0, 1.0);
  return clamp(radius + 0.5 - sqrt(x * x + y * y), 0.0, 1.0);
}

// Radius of a kernel in texels of its mip: at least half a texel, as a smaller one could miss all texels, and at most
// the radius that N texels hold.
float covering_radius(Kernel k, float width, int texels) {
  return clamp(0.5 * width / k.square.texel, 0.5, 0.5 * float(texels - 1));
}

#ifndef GLOAM_SHADOWS_STANDARD
// Blocked share of N × N texels, each weighted by the part of it that the disc (or square) covers.
float blocked_share_any(ShadowPoint p, int mip, float width, int texels) {
  Kernel k = make_kernel(p, mip, texels);
  float radius = covering_radius(k, width, texels);
  SearchCone cone = kernel_cone(p, k, width);
  vec4 all = vec4(0.0), blocked = vec4(0.0);
  for (int y = 1; y < texels; y += 2) {
    for (int x = 1; x < texels; x += 2) {
      vec2 corner = k.base + vec2(x, y);
      vec2 off = corner - k.at;
      vec4 weight = covered(radius, off.x + vec4(-0.5, 0.5, 0.5, -0.5), off.y + vec4(0.5, 0.5, -0.5, -0.5));
      vec4 least = max(cone_depths(cone, off.x + vec4(-0.5, 0.5, 0.5, -0.5)),
                       cone_depths(cone, off.y + vec4(0.5, 0.5, -0.5, -0.5)));
      corner = clamp(corner, vec2(1.0), vec2(k.square.size - 1.0));
      all += weight;
      vec4 depth = gather_depth(k, corner), threshold = max(gather_threshold(k, corner, k.least), least);
      blocked += weight * coverage(depth) * vec4(greaterThan(depth, threshold));
    }
  }
  return dot(blocked, vec4(1.0)) / dot(all, vec4(1.0));
}
#endif

// The two mips in which a penumbra of a given width is filtered.
struct FilterMips {
  int fine;
  int coarse;
  float blend;  // weight of the coarse one
};

FilterMips filter_mips(ShadowPoint p, float width) {
  int last = coarsest_mip(p, kKernel);
  float level =
      max(2.0 * width / float(kKernel), 1.0);  // in mip log2(level) the penumbra is half as wide as the kernel
  int fine = min(floor_log2(level), last);
  float blend = fine < last ? clamp(log2(level * power_of_two(-fine)), 0.0, 1.0) : 0.0;
  return FilterMips(fine, min(fine + 1, last), blend);
}

// Whether the kernel of a penumbra needs other cube faces. Beyond the penumbra and a texel, weights are close to 0.
bool filter_leaves_face(ShadowPoint p, FilterMips mips, float width) {
  return leaves_cube_face(p, 0.5 * width + power_of_two(mips.fine));
}

#ifdef GLOAM_SHADOWS_CROSSING
// The direction of the receiver in its cube face, and what makes the outline of the emitter, a sphere, a circle.
struct RoundOutline {
  vec3 toward;     // tangents and 1
  float to_texel;  // texels of mip 0 per tangent
  float stretch;   // half of the outline's long axis in the face, over the radius of the circle of the same area
};

RoundOutline round_outline(ShadowPoint p) {
  float to_texel = 0.5 * p.size / p.tan_half;
  vec3 toward = vec3((p.at - 0.5 * p.size) / to_texel, 1.0);
  return RoundOutline(toward, to_texel, sqrt(length(toward)));
}

// Distance of a texel coordinate of mip 0 from the receiver, in texels, scaled so that the emitter's outline is the
// circle of the same area.
float round_distance(ShadowPoint p, RoundOutline o, vec2 at) {
  vec3 v = vec3((at - 0.5 * p.size) / o.to_texel, 1.0);
  float along = max(dot(v, o.toward), 1e-3);
  return length(v * (dot(o.toward, o.toward) / along) - o.toward) * o.stretch * o.to_texel;
}

// Blocked share of a kernel that leaves the receiver's cube face, texel by texel, in the finest mip whose N × N texels
// hold the penumbra. Texels of another face do not lie on the grid of the receiver's, so each is weighted where it is.
float blocked_share_across(ShadowPoint p, float width, bool across) {
  RoundOutline outline = round_outline(p);
  int mip = clamp(ceil_log2(max(width * outline.stretch / float(kKernel - 1), 1.0)), 0, coarsest_mip(p, kKernel));
  Kernel k = make_kernel(p, mip, kKernel);
  SearchCone cone = kernel_cone(p, k, width);
  // A texel of the kernel and one of the map's edges blur by 1/12 texel² each, a disc of radius r by r² / 4.
  float radius = covering_radius(k, width, kKernel);
  radius = sqrt(max(radius * radius - 2.0 / 3.0, 0.25));
  float all = 0.0, blocked = 0.0;
  int i = 0;
  while (across && i < kKernel * kKernel) {  // not do … while: a repeated body would change the sums, see never()
    vec2 at = (k.base + vec2(i % kKernel, i / kKernel) + 0.5) * k.square.texel;
    float rise, share;
    float depth = cube_depth(p, at, mip, rise, share);
    vec2 off = at / k.square.texel - k.at;
    vec4 least = cone_depths(cone, vec4(off, 0.0, 0.0));
    float weight = covered(radius, vec4(round_distance(p, outline, at) / k.square.texel), vec4(0.0)).x;
    all += weight;
    blocked += depth > max(tap_threshold(p, k, at, k.least, rise), max(least.x, least.y)) ? weight * share : 0.0;
    ++i;
  }
  return all > 0.0 ? blocked / all : 0.0;
}
#endif

// Filtered visibility for a penumbra of this width, in texels of mip 0.
float kernel_visibility(ShadowPoint p, float width) {
  FilterMips mips = filter_mips(p, width);
  bool across = filter_leaves_face(p, mips, width);
  float share = 0.0;
  int turns = mips.blend > 0.0 || kFullPenumbra != 0u ? 2 : 1;
  int turn = 0;
  do {
    share = turn == 0 ? 0.0 : share;  // reset, as the body may run again: see never()
    int mip = turn == 0 ? mips.fine : mips.coarse;
    float part = turn == 0 ? 1.0 - mips.blend : mips.blend;
#ifdef GLOAM_SHADOWS_STANDARD
    float blocked = blocked_share_8(p, mip, width);
#else
    float blocked = kKernel == 8 ? blocked_share_8(p, mip, width) : blocked_share_any(p, mip, width, kKernel);
#endif
    share += across ? 0.0 : part * blocked;
  } while (++turn < turns);
#ifdef GLOAM_SHADOWS_CROSSING
  share += blocked_share_across(p, width, across);
#endif
  return 1.0 - share;
}

// The same. Negative widths: near_visibility() with this tangent and these sectors.
float filtered_visibility(ShadowPoint p, float width, uint sectors) {
  float near = near_visibility(p, -width, width < 0.0 ? sectors : 0u), filtered = kernel_visibility(p, width);
  return width < 0.0 ? near : filtered;
}

// Whether all of the region blocks.
bool surely_unlit(ShadowPoint p, SearchRegion region) {
  float slope = slope_per_texel(p) * (0.5 * region.width + 2.0);
  return region.farthest > p.threshold + slope && kFullPenumbra == 0u;
}

// Whether a receiver's visibility is known without the filter. If so, it is `visibility`; otherwise
// filtered_visibility() gives it, for a penumbra of `width` and these `sectors`.
bool known_before_filter(ShadowPoint p, out float visibility, out float width, out uint sectors) {
  SearchRegion region = SearchRegion(0.0, 0.0, 0.0);
  if (p.live) do {
      region = find_region(p);
    } while (never(p));
  bool unlit = surely_unlit(p, region);
  bool unsure = region.nearest > p.threshold || kFullPenumbra != 0u;
  visibility = unlit && p.live ? 0.0 : 1.0;
  width = 0.0;
  bool known = true;
  float tangent = region.width * p.tan_half / p.size;  // half of the region
  bool wide =
      kNear != 0u && !p.orthographic && tangent > kNearTangent && kFullPenumbra == 0u && p.live && unsure && !unlit;
  // Off the face's axis, tangents to the receiver's direction are up to twice as large.
  NearBounds bounds = near_bounds(p, near_frame(p), 2.0 * tangent, wide);
  bool near = bounds.reach > kNearTangent;
  visibility = bounds.umbra ? 0.0 : visibility;
  unsure = unsure && (!wide || bounds.reach > 0.0);
  if (near) {
    known = false;
    width = -min(2.0 * tangent, bounds.reach);
  }
  sectors = bounds.sectors;
  if (wide) region.width = min(region.width, 2.0 * bounds.reach * p.size / p.tan_half);
  if (!near && p.live && unsure && !unlit) do {
      Blockers blockers = region_blockers(p, region);
      width = penumbra_width(p, blockers.depth);
      known = blockers.count <= 1e-3 && kFullPenumbra == 0u;
    } while (never(p));
  return known;
}

float chs_visibility(ShadowPoint p) {
  float visibility, width;
  uint sectors;
  bool known = known_before_filter(p, visibility, width, sectors);
  if (!known) do {
      visibility = filtered_visibility(p, width, sectors);
    } while (never(p));
  return visibility;
}

#endif
