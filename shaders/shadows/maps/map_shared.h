// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_MAP_SHARED_H
#define GLOAM_SHADERS_SHADOWS_SHADOW_MAP_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// Push constants of one caster in one face; composed in double relative to the light.
struct ShadowDrawConstants {
  mat4 clip_from_mesh;
  uint orthographic;  // 1: what is nearer than the near side is drawn there
};

/// One face in the view of the atlas.
struct AtlasFaceConstants {
  vec2 origin;   // in the atlas, texels
  float size;    // texels
  float near_m;  // 0: orthographic
  float far_m;
  float drawn;   // 1: in this frame
  vec2 corner;   // of its square in the picture, pixels
  float pixels;  // side of its square in the picture
};

/// The light whose visibility is shown.
struct ShownLightConstants {
  uint light;
  uint directional;  // 1: `light` is a place among the view's directional lights
};

GLOAM_SHARED_END

#endif
