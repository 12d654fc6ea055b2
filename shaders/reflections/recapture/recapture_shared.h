// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_RECAPTURE_SHARED_H
#define GLOAM_SHADERS_REFLECTIONS_RECAPTURE_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

struct RecaptureConstants {
  float scale;       // from the light of the drawn view to that of captures
  uint upside_down;  // 1: rows of the capture run from the bottom (of mirrored nodes)
};

GLOAM_SHARED_END

#define GLOAM_RECAPTURE_PIXELS 2  // drawn pixels per texel, in each direction

#endif
