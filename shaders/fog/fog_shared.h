// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_FOG_FOG_SHARED_H
#define GLOAM_SHADERS_FOG_FOG_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// Constants of one direction of the separable blur of scattered light.
struct FogBlurConstants {
  ivec2 direction;      // (1, 0) or (0, 1)
  int taps;             // texels on each side of the centre
  float inverse_sigma;  // 1 / standard deviation in texels of the blurred image
};

struct FogConstants {
  vec4 radiance;         // rgb in-scattered radiance, cd/m²
  float density;         // 1/m
  float forward;         // share of the scattered light that nearly keeps its direction
  float sky_distance_m;  // path length through the fog for sky pixels
};

GLOAM_SHARED_END

#endif
