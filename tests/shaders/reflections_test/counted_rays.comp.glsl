// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require
#extension GL_GOOGLE_include_directive : require

// screen_space_rays.comp, which counts the rays that it follows.
layout(constant_id = 2) const uint kFollowAll = 0u;  // 1: no ray is left out

layout(set = 0, binding = 11, scalar) buffer Count { uint followed_rays; };

bool counted(bool followed) {
  if (kFollowAll != 0u) followed = true;
  if (followed) atomicAdd(followed_rays, 1u);
  return followed;
}
#define GLOAM_FOLLOWED(followed) counted(followed)

#include "shaders/reflections/passes/screen_space_rays.glsl"
