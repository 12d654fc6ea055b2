// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_OCCLUSION_SHARED_H
#define GLOAM_SHADERS_LIGHTING_OCCLUSION_SHARED_H

#include "shaders/common/prelude.h"

#define GLOAM_OCCLUSION_SCALE 2  // pixels of the picture along one side of a texel of the estimate

GLOAM_SHARED_BEGIN

struct OcclusionConstants {
  float metre;  // units of the scene
};

GLOAM_SHARED_END

#endif
