// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shadows/maps/mips_shared.h"

// Copies the depth of resting casters from the scratch image into the image of backgrounds. Each thread copies a block
// of 8 × 8 texels.

layout(local_size_x = GLOAM_SHADOW_MIP_GROUP, local_size_y = GLOAM_SHADOW_MIP_GROUP) in;
layout(set = 0, binding = 0) uniform sampler2DArray scratch;
layout(set = 0, binding = 1, r32f) writeonly uniform image2DArray backgrounds;
layout(set = 0, binding = 2, scalar) readonly buffer Groups { ShadowMipGroup groups[]; };
layout(push_constant, scalar) uniform Constants { ShadowMipConstants run; };

void main() {
  ShadowMipGroup face = groups[run.first_group + gl_WorkGroupID.x];
  uvec2 block = face.begin + gl_LocalInvocationID.xy;
  if (any(greaterThanEqual(block, face.end))) return;
  for (uint i = 0u; i < GLOAM_SHADOW_MIP_BLOCK * GLOAM_SHADOW_MIP_BLOCK; ++i) {
    uvec2 at = block * GLOAM_SHADOW_MIP_BLOCK + uvec2(i % GLOAM_SHADOW_MIP_BLOCK, i / GLOAM_SHADOW_MIP_BLOCK);
    float depth = texelFetch(scratch, ivec3(at, face.layer), 0).x;
    imageStore(backgrounds, ivec3(face.origin + at, 0), vec4(depth));
  }
}
