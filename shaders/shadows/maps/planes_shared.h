// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_PLANES_SHARED_H
#define GLOAM_SHADERS_SHADOWS_SHADOW_PLANES_SHARED_H

#include "shaders/common/prelude.h"

// Planes that bound the depths of shadow maps (rgba32f). A texel of level l stands for a block of 8 · 2^l × 8 · 2^l
// texels of mip 0; levels are laid out as the mips of an atlas of W / 8. All depths of the block that are not empty are
// at most x + y · (column − middle) + z · (row − middle), with columns and rows in texels of mip 0. w: the nearest
// depth in the block, 0 when it is empty. If the block shows a single surface, the plane follows it.

#define GLOAM_SHADOW_PLANE_BLOCK 8
#define GLOAM_SHADOW_PLANE_LEVELS 4
#define GLOAM_SHADOW_PLANE_GROUP 8  // workgroups of planes.comp have this many threads squared

GLOAM_SHARED_BEGIN

/// One dispatch of planes.comp: parts of any number of faces.
struct ShadowPlaneConstants {
  uint first_level;  // 0: makes level 0 from the atlas; 1: makes the others from level 0
  uint atlas_size;
  uint first_group;  // index of the dispatch's first workgroup in the buffer of groups
};

/// One workgroup's part of a face.
struct ShadowPlaneGroup {
  uvec2 origin;  // corner of the face in the atlas, texels of mip 0
  uvec2 begin;   // first texel of the part in the face, in texels of level 0, or of the last level for the others
  uvec2 end;     // one past its last texel
  uint size;     // side of the face, texels of mip 0
};

GLOAM_SHARED_END

#endif
