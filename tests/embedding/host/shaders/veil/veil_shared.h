// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef HOST_SHADERS_VEIL_VEIL_SHARED_H
#define HOST_SHADERS_VEIL_VEIL_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

struct VeilConstants {
  vec3 albedo;    // share of the surroundings' light that the mist scatters
  float density;  // 1/m
};

struct VeilAverage {
  float share;  // of this frame in the average; 1: `previous` has no content
  int stride;   // texels from one that counts to the next
};

GLOAM_SHARED_END

#endif
