// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_THIN_SURFACES_GLSL
#define GLOAM_SHADERS_SHADOWS_THIN_SURFACES_GLSL

#include "shaders/shadows/filter/contact_hardening.glsl"

// The filter for thin surfaces (kThinFilter). Neighbouring pixels of blades lie on different blades, so the eye sees
// the mean over many pixels and not the shape of one penumbra. Blockers are searched as by chs, but filtered in the
// finer of the two mips only. There is no estimate of near blockers, and all texels are those of the receiver's face,
// whose rim is wider than most kernels. Where chs finds no blocker in the face, or all of the region blocks, the result
// is the same.

// The receiver must be live.
float thin_visibility(ShadowPoint p) {
  SearchRegion region = find_region_in_face(p);
  int mip = region_mip(p, region);
  float half_width = 0.5 * region.width * power_of_two(-mip);
#ifdef GLOAM_SHADOWS_STANDARD
  Blockers blockers = find_blockers_8(p, mip, false, half_width);
#else
  Blockers blockers = find_blockers(p, mip, kKernel, false, half_width);
#endif
  float width = penumbra_width(p, blockers.depth);
#ifdef GLOAM_SHADOWS_STANDARD
  float share = blocked_share_8(p, filter_mips(p, width).fine, width);
#else
  float share = blocked_share_any(p, filter_mips(p, width).fine, width, kKernel);
#endif
  bool lit = region.nearest <= p.threshold || blockers.count <= 1e-3;
  return surely_unlit(p, region) ? 0.0 : lit ? 1.0 : 1.0 - share;
}

// The contact-hardening filter, or that of thin surfaces.
float chs_or_thin_visibility(ShadowPoint p) {
  bool live = p.live, thin = kThinFilter != 0u && p.thin && live;
  p.live = live && !thin;
  float visibility = chs_visibility(p);
  p.live = live;
  if (kThinFilter != 0u && thin) do {
      visibility = thin_visibility(p);
    } while (never(p));
  return visibility;
}

#endif
