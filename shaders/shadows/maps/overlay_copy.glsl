// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_OVERLAY_COPY_GLSL
#define GLOAM_SHADERS_SHADOWS_SHADOW_OVERLAY_COPY_GLSL

#include "shaders/shadows/maps/mips_shared.h"

// Copies mip 0 of faces into other squares of the atlas. The copies must not overlap any face that is copied. Each
// thread copies a block of 8 × 8 texels. Before including this, define GLOAM_SHADOW_ATLAS_FORMAT.

layout(local_size_x = GLOAM_SHADOW_MIP_GROUP, local_size_y = GLOAM_SHADOW_MIP_GROUP) in;
layout(set = 0, binding = 0, GLOAM_SHADOW_ATLAS_FORMAT) uniform image2D atlas;
layout(set = 0, binding = 1, scalar) readonly buffer Groups { ShadowCopyGroup groups[]; };
layout(push_constant, scalar) uniform Constants { ShadowCopyConstants run; };

void main() {
  ShadowCopyGroup face = groups[run.first_group + gl_WorkGroupID.x];
  uvec2 block = face.begin + gl_LocalInvocationID.xy;
  if (any(greaterThanEqual(block, face.end))) return;
  for (uint i = 0u; i < GLOAM_SHADOW_MIP_BLOCK * GLOAM_SHADOW_MIP_BLOCK; ++i) {
    uvec2 at = block * GLOAM_SHADOW_MIP_BLOCK + uvec2(i % GLOAM_SHADOW_MIP_BLOCK, i / GLOAM_SHADOW_MIP_BLOCK);
    imageStore(atlas, ivec2(face.copy + at), imageLoad(atlas, ivec2(face.origin + at)));
  }
}

#endif
