// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_LIGHTING_SHARED_H
#define GLOAM_SHADERS_LIGHTING_LIGHTING_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// What lights a scene besides its lights. Colours in cd/m².
struct EnvironmentConstants {
  vec4 zenith;
  vec4 horizon;
  vec4 ground;
};

/// How linear light becomes a picture.
struct ToneMapConstants {
  uint curve;          // 0 filmic, 1 reinhard, 2 linear
  uint exposure_slot;  // of the exposure buffer
  uint metered;        // 1: take the slot's exposure, 0: the one below
  float exposure;      // factor on cd/m²
  uint encode_srgb;    // 1: the target does not encode by itself
};

/// A tabulated tone curve.
struct ToneTableConstants {
  uint curve;
  uint size;  // texels
};

/// Metering of one view into a slot.
struct MeterConstants {
  uvec2 size;  // pixels of the picture
  uint slot;
};

GLOAM_SHARED_END

#endif
