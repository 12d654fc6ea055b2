// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_FOG_PATH_GLSL
#define GLOAM_SHADERS_FOG_PATH_GLSL

#include "shaders/fog/fog_shared.h"
#include "shaders/render/view_api.glsl"

layout(constant_id = 0) const uint kOrthographic = 0u;

// Share of the light that fog scatters on the way from a pixel's surface: 1 - exp(-density · d) at distance d. pixel:
// its middle, with the origin in the corner of the picture.
float scattered_share(ViewConstants view, FogConstants fog, vec2 pixel, float depth) {
  // The bound keeps the distance of a sky pixel, which is not used, free of 0 / 0. Depths below it are farther than the
  // sky's distance with any near plane.
  float distance_m = kOrthographic != 0u ? view_depth(view, relative_position(view, pixel - 0.5, depth))
                                         : perspective_distance(view, pixel - 0.5, max(depth, 1e-30));
  if (depth <= 0.0) distance_m = fog.sky_distance_m;
  return 1.0 - exp(-fog.density * min(distance_m, fog.sky_distance_m));
}

#endif
