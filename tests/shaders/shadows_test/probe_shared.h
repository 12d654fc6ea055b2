// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_TESTS_SHADOW_PROBE_SHARED_H
#define GLOAM_TESTS_SHADOW_PROBE_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// A receiver and a light that probe.comp evaluates.
struct ShadowProbe {
  vec3 position;  // camera-relative
  uint light;     // index of a local light, or of a directional one
  vec3 face_normal;
  uint flags;         // GLOAM_SHADOW_PROBE_…
  vec3 light_vector;  // position of the local light, or the direction in which a directional light shines
  uint reserved;
};

/// The result of one probe.
struct ShadowProbeResult {
  float visibility;     // quantised, as in shading
  float region_width;   // of the search region, texels of mip 0
  float nearest;        // nearest depth in the search region
  float blocker_count;  // Blockers::count
  float blocker_depth;  // Blockers::depth
  float penumbra;       // width, texels of mip 0
  vec2 cookie;          // red, green
};

GLOAM_SHARED_END

#define GLOAM_SHADOW_PROBE_DIRECTIONAL 1
#define GLOAM_SHADOW_PROBE_SUBSURFACE 2
#define GLOAM_SHADOW_PROBE_GROUP 64  // threads per workgroup

#endif
