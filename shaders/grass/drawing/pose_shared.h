// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_DRAWING_POSE_SHARED_H
#define GLOAM_SHADERS_GRASS_DRAWING_POSE_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// One live blade as a view draws it, in metres: how its knots follow from those of its master, and its width. Written
/// by pose.comp once per blade, so that its vertices need not compute it.
struct GrassPose {
  vec4 row0;  // rows of the matrix from the master's knots, in the patch, to camera-relative positions
  vec4 row1;
  vec4 row2;
  uint first_knot;  // of the master
  uint side;        // octahedral, snorm16: across the blade at the root
  uint width;       // packHalf2x16(width at the root in metres, after the LOD; taper)
  uint layer;       // grass_color(); threshold of pixel_width.glsl: unorm16 << 16
  vec3 carried;     // way of the root since the frame before, because the ground has moved
};

/// A part of a shadow map's face: blades whose bounding sphere is outside of any plane cast nothing into it.
struct GrassCasterPart {
  vec4 planes[5];  // camera-relative, in units: inside is dot(xyz, p) + w >= 0
  vec4 reach;      // camera-relative place of the light, and how far it reaches; 0: without limit
};

GLOAM_SHARED_END

#endif
