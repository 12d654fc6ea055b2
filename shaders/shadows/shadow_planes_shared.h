// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_PLANES_SHARED_H
#define GLOAM_SHADERS_SHADOWS_SHADOW_PLANES_SHARED_H

#include "shaders/common/prelude.h"

// Planes above what shadow maps hold (rgba32f). A texel of level l stands for a block of 8 · 2^l texels of mip 0, and is laid out as mips of
// an atlas of W / 8. No texel of the block is nearer than x + y · (column − middle) + z · (row − middle), columns and rows in texels of mip
// 0; w: the nearest depth in the block, 0 where it is empty. Where a block shows one surface the plane is that surface's.

#define GLOAM_SHADOW_PLANE_BLOCK 8
#define GLOAM_SHADOW_PLANE_LEVELS 4

GLOAM_SHARED_BEGIN

/// One stretch of a face (shadow_planes.comp).
struct ShadowPlaneConstants {
  uvec2 origin;     // of the face in the atlas, texels of mip 0
  uvec2 first;      // of the stretch in the face, texels of mip 0; a multiple of 64, or 0
  uvec2 texels;     // of the stretch; likewise, or what the face has
  uint first_level; // 0: level 0 from the atlas; 1: the others from level 0
  uint atlas_size;
  uint face_size;   // texels of mip 0
};

GLOAM_SHARED_END

#endif
