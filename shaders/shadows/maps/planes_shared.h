// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_PLANES_SHARED_H
#define GLOAM_SHADERS_SHADOWS_SHADOW_PLANES_SHARED_H

#include "shaders/common/prelude.h"

// Planes above what shadow maps hold (rgba32f). A texel of level l stands for a block of 8 · 2^l texels of mip 0, and
// is laid out as mips of an atlas of W / 8. No texel of the block is nearer than x + y · (column − middle) + z · (row −
// middle), columns and rows in texels of mip 0; w: the nearest depth in the block, 0 where it is empty. Where a block
// shows one surface the plane is that surface's.

#define GLOAM_SHADOW_PLANE_BLOCK 8
#define GLOAM_SHADOW_PLANE_LEVELS 4
#define GLOAM_SHADOW_PLANE_GROUP 8  // threads of a side of a workgroup of shadow_planes.comp

GLOAM_SHARED_BEGIN

/// One dispatch of shadow_planes.comp: stretches of any number of faces.
struct ShadowPlaneConstants {
  uint first_level;  // 0: level 0 from the atlas; 1: the others from level 0
  uint atlas_size;
  uint first_group;  // of the dispatch's workgroups, in the buffer of groups
};

/// One workgroup's part of a face.
struct ShadowPlaneGroup {
  uvec2 origin;  // of the face in the atlas, texels of mip 0
  uvec2 begin;  // corner of the stretch in the face, in texels of level 0, or of the last one where the others are made
  uvec2 end;    // the corner across from it, before which it ends
  uint size;    // of the face, texels of mip 0
};

GLOAM_SHARED_END

#endif
