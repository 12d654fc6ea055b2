// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/depth_of_field/depth_of_field_shared.h"

// Empties the lists and the circles of the picture.

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) writeonly buffer Lists { DofList lists[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer PictureBounds { DofPictureBounds picture; };

void main() {
  uint list = gl_LocalInvocationIndex;
  if (list < uint(GLOAM_DOF_LISTS)) lists[list] = DofList(0u, 1u, 1u, 0u);
  if (list == 0u) picture = DofPictureBounds(0u, 0u, 0u, 0u);
}
