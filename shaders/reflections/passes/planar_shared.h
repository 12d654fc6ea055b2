// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_PLANAR_PLANAR_SHARED_H
#define GLOAM_SHADERS_REFLECTIONS_PLANAR_PLANAR_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// The horizontal plane at which a view is mirrored.
struct PlanarConstants {
  float height_m;  // above the camera; mostly negative
  float slack_m;   // surfaces at most this far from it show the mirrored picture
};

GLOAM_SHARED_END

#endif
