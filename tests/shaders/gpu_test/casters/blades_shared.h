// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_TESTS_BLADES_SHARED_H
#define GLOAM_TESTS_BLADES_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// A triangle: root − (half_width, 0, 0), root + (half_width, 0, 0), tip. Metres, relative to the origin of its field.
struct Blade {
  vec3 root;
  float half_width;
  vec3 tip;
  float unused;
};

struct SwayConstants {
  uint count;
  float phase;  // radians
  float reach;  // metres that tips move along X
};

GLOAM_SHARED_END

#endif
