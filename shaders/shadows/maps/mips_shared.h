// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_MIPS_SHARED_H
#define GLOAM_SHADERS_SHADOWS_SHADOW_MIPS_SHARED_H

#include "shaders/common/prelude.h"

#define GLOAM_SHADOW_MIP_BLOCK 8  // a thread of mips.comp processes this many source texels squared
#define GLOAM_SHADOW_MIP_GROUP 8  // workgroups of mips.comp have this many threads squared
#define GLOAM_SHADOW_MIP_RUN 3    // mips that one dispatch makes

// Low bits of a depth in coverage mips: how many 64ths of the texel its surface leaves free; 0 in mip 0.
#define GLOAM_SHADOW_FREE_BITS 63u

#define GLOAM_SHADOW_MIPS_AS_PUSHED 3  // default of kMipOperator: ShadowMipConstants::mip_operator

GLOAM_SHARED_BEGIN

/// One dispatch of mips.comp, mips_in_place.comp or backgrounds.comp: a run of mips for parts of any number of faces.
struct ShadowMipConstants {
  uint first;         // source mip; 0: the scratch image, or mip 0 in place
  uint mip_operator;  // GLOAM_SHADOW_MIPS_…
  uint atlas_size;
  uint first_group;  // index of the dispatch's first workgroup in the buffer of groups
};

/// One workgroup's part of a face.
struct ShadowMipGroup {
  uvec2 origin;        // corner of the face in the atlas, texels of mip 0
  uvec2 begin;         // first block of the part in the face, in blocks of the source
  uvec2 end;           // one past its last block
  uint size;           // side of the face, texels of mip 0
  uint layer;          // layer of the scratch image
  uint orthographic;   // 1: depth is linear
  uint on_background;  // 1: the first run merges the image of backgrounds
  float gap;           // coverage: greatest depth step of one surface per texel of mip 0, as a share of its distance
                       // (orthographic: a depth)
  float depth_scale;   // 16-bit maps: factor of depths in the scratch image; what is then above 1 is stored as 1
};

/// One dispatch of overlay_copy.comp: parts of any number of faces.
struct ShadowCopyConstants {
  uint first_group;  // index of the dispatch's first workgroup in the buffer of groups
};

/// One workgroup's part of a face.
struct ShadowCopyGroup {
  uvec2 origin;  // corner of the face in the atlas, texels of mip 0
  uvec2 copy;    // corner of its copy
  uvec2 begin;   // first block of the part in the face
  uvec2 end;     // one past its last block
};

GLOAM_SHARED_END

#endif
