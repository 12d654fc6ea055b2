// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef HOST_SHADERS_VEIL_VEIL_SHARED_H
#define HOST_SHADERS_VEIL_VEIL_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

struct VeilConstants {
  vec3 radiance;  // cd/m²
  float density;  // 1/m
};

GLOAM_SHARED_END

#endif
