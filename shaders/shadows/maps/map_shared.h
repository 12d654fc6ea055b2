// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_MAP_SHARED_H
#define GLOAM_SHADERS_SHADOWS_SHADOW_MAP_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// One face in visualizer shadow_atlas.
struct AtlasFaceConstants {
  vec2 origin;   // corner in the atlas, texels
  float size;    // texels of a side
  float near_m;  // 0: orthographic
  float far_m;
  float drawn;   // 1: drawn in this frame
  vec2 corner;   // corner of its square in the picture, pixels
  float pixels;  // side of its square in the picture
};

/// The light that a visualizer shows.
struct ShownLightConstants {
  uint light;
  uint directional;  // 1: `light` is an index among the view's directional lights, else among its local ones
};

GLOAM_SHARED_END

#endif
