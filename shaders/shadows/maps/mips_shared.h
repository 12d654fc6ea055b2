// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_MIPS_SHARED_H
#define GLOAM_SHADERS_SHADOWS_SHADOW_MIPS_SHARED_H

#include "shaders/common/prelude.h"

#define GLOAM_SHADOW_MIP_BLOCK 8  // texels of the source, along a side, that a thread of shadow_mips.comp takes
#define GLOAM_SHADOW_MIP_GROUP 8  // threads of a side of its workgroups
#define GLOAM_SHADOW_MIP_RUN 3    // mips that a dispatch makes

#define GLOAM_SHADOW_FREE_BITS \
  63u  // of a depth: what its surface leaves free of a texel, in 64ths (GLOAM_SHADOW_MIPS_COVERAGE); 0 in mip 0

GLOAM_SHARED_BEGIN

/// One dispatch of shadow_mips.comp, shadow_mips_in_place.comp or shadow_backgrounds.comp: a run of mips of parts of
/// any number of faces.
struct ShadowMipConstants {
  uint first;         // 0: from the scratch map, or in place from mip 0; else the mip that is there already
  uint mip_operator;  // GLOAM_SHADOW_MIPS_…
  uint atlas_size;
  uint first_group;  // of the dispatch's workgroups, in the buffer of groups
};

/// One workgroup's part of a face.
struct ShadowMipGroup {
  uvec2 origin;        // of the face in the atlas, texels of mip 0
  uvec2 begin;         // corner of what is made anew in the face, in blocks of the source
  uvec2 end;           // the corner across from it, before which it ends
  uint size;           // of the face, texels of mip 0
  uint layer;          // of the scratch map
  uint orthographic;   // depth is linear already
  uint on_background;  // run 0: what the image of backgrounds holds there is drawn too
  float gap;           // coverage: how far a surface recedes over a texel of mip 0 at most, as a share of its distance
                       // (orthographic: depth)
};

/// One dispatch of shadow_overlay_copy.comp: parts of any number of faces.
struct ShadowCopyConstants {
  uint first_group;  // of the dispatch's workgroups, in the buffer of groups
};

/// One workgroup's part of a face.
struct ShadowCopyGroup {
  uvec2 origin;  // of the face in the atlas, texels of mip 0
  uvec2 copy;    // the same of its copy
  uvec2 begin;   // corner of the part in the face, in blocks of texels
  uvec2 end;     // the corner across from it, before which it ends
};

GLOAM_SHARED_END

#endif
