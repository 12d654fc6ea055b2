// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_LOD_LOD_API_GLSL
#define GLOAM_SHADERS_GRASS_LOD_LOD_API_GLSL

#include "shaders/grass/lod/lod_shared.h"

// Thinning of the field with distance. At a distance where a blade's root is narrower than GrassLod::width_px pixels,
// only the share of blades is kept whose widened roots would cover as much as all of them: blades of a low rank. A
// blade's width falls to 0 before it is left out, and the others widen at the same time, so nothing pops.

const float kFadeOfRank = 0.25;  // blades fade while their rank is between the share and 1.25 times the share
const float kFadeOfRange = 0.1;  // last part of the range, in which all blades narrow to 0
const float kLeastShare = 1.0 / 16.0;

// Share of blades that are kept at a distance.
float grass_share(GrassLod lod, float width_m, float distance_m) {
  float pixel_m = lod.pixel_m * (lod.orthographic != 0u ? 1.0 : distance_m);
  float share = lod.width_px > 0.0 ? width_m / max(lod.width_px * pixel_m, 1e-9) : 1.0;
  return clamp(share, kLeastShare, 1.0);
}

// Factor of the width of a blade of this rank: 0 if it is left out.
float grass_width_factor(GrassLod lod, float share, float rank, float distance_m, float max_distance_m) {
  float end = share * (1.0 + kFadeOfRank);
  float kept = share < 1.0 ? clamp((end - rank) / (kFadeOfRank * share), 0.0, 1.0) : 1.0;
  // Mean of `kept` over all ranks: the integral from 0 to 1.
  float fading = min(end, 1.0);
  float cover = share + (fading - share) * (end - 0.5 * (share + fading)) / (kFadeOfRank * share);
  float near = clamp((max_distance_m - distance_m) / (kFadeOfRange * max_distance_m), 0.0, 1.0);
  return kept * near / (share < 1.0 ? cover : 1.0);
}

#endif
