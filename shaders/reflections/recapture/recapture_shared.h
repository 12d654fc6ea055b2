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

/// A direction around a texel's direction from which a probe's map takes light.
struct ProbeSample {
  vec3 direction;
  float weight;  // the weights of a texel sum to 1
  float lod;     // of the faces
};

struct ProbeMapConstants {
  uint samples;
  uint exact;  // 1: the mean of the texel, without a lobe
};

GLOAM_SHARED_END

#define GLOAM_RECAPTURE_PIXELS 2  // drawn pixels per texel of a proxy, in each direction

#endif
