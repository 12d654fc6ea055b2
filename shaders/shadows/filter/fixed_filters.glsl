// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_FIXED_FILTERS_GLSL
#define GLOAM_SHADERS_SHADOWS_FIXED_FILTERS_GLSL

#include "shaders/shadows/filter/contact_hardening.glsl"

// The filters that contact hardening is compared with. All read mip 0 only.

// One comparison with the nearest texel.
float hard_visibility(ShadowPoint p) {
  float visibility = 1.0;
  if (p.live) do {
      Kernel k = make_kernel(p, 0, 2);
      vec2 at = p.at;
      float depth = tap_depth(p, at, false);
      visibility = depth > tap_threshold(p, k, at, k.least) ? 0.0 : 1.0;
    } while (never(p));
  return visibility;
}

// A box of N × N texels with bilinear edges, the same for every light.
float pcf_visibility(ShadowPoint p) {
  float visibility = 1.0;
  if (p.live) do {
      Blockers blocked = box_blockers(p, 0, kKernel, true, 0.0);
      visibility = 1.0 - blocked.count / float((kKernel - 1) * (kKernel - 1));
    } while (never(p));
  return visibility;
}

// N × N single fetches, spread over a square of `width` texels. Returns x: share of the fetches that block; y: depth at
// the mean distance of the blockers (the receiver's depth if there are none). search: true for the blocker search,
// which has equal weights and counts only blockers nearer to the light than the receiver; false for the filter, with
// the filter's weights. across: texels may be in other cube faces.
vec2 spread_taps(ShadowPoint p, float width, bool search, bool across) {
  Kernel k = make_kernel(p, 0, 2);
  float least = search ? max(k.least, p.threshold) : k.least;
  float spacing = width / float(kKernel);
  float all = 0.0, count = 0.0, sum = 0.0;
  for (int i = 0; i < kKernel * kKernel; ++i) {
    vec2 off = vec2(i % kKernel, i / kKernel) - 0.5 * float(kKernel - 1);
    vec2 at = p.at + off * spacing;
    float depth = tap_depth(p, at, across);
    float threshold = tap_threshold(p, k, at, least);
    float weight = search ? 1.0 : covered(0.5 * float(kKernel), vec4(off.x), vec4(off.y)).x;
    all += weight;
    weight = depth > threshold ? weight : 0.0;
    count += weight;
    sum += weight * (p.orthographic ? depth : 1.0 / max(depth, threshold));
  }
  float mean = sum / max(count, 1e-6);
  return vec2(count / all, count <= 1e-6 ? p.depth : p.orthographic ? mean : 1.0 / mean);
}

vec2 spread(ShadowPoint p, float width, bool search) {
  vec2 found = vec2(0.0, p.depth);
  bool across = leaves_cube_face(p, 0.5 * width);
  if (!across) do {
      found = spread_taps(p, width, search, false);
    } while (never(p));
  if (across) do {
      found = spread_taps(p, width, search, true);
    } while (never(p));
  return found;
}

// Percentage-closer soft shadows (Fernando 2005): 2 N² single fetches, no mips.
float pcss_visibility(ShadowPoint p) {
  SearchRegion region = SearchRegion(0.0, 0.0, 0.0);
  if (p.live) do {
      region = find_region(p);
    } while (never(p));
  float visibility = 1.0;
  if (p.live && (region.nearest > p.threshold || kFullPenumbra != 0u)) do {
      vec2 blockers = spread(p, max(region.width, float(kKernel)), true);
      float width = max(penumbra_width(p, blockers.y), 1.0);
      if (blockers.x > 0.0 || kFullPenumbra != 0u) do {
          visibility = 1.0 - spread(p, width, false).x;
        } while (never(p));
    } while (never(p));
  return visibility;
}

#endif
