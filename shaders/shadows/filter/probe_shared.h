// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOW_PROBE_SHARED_H
#define GLOAM_SHADERS_SHADOWS_SHADOW_PROBE_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// A point that shadow_probe.comp.glsl looks at one light from.
struct ShadowProbe {
  vec3 position;
  uint light;  // index of a local light, or of a directional one
  vec3 face_normal;
  uint flags;         // GLOAM_SHADOW_PROBE_…
  vec3 light_vector;  // position of the local light, or where a directional one shines
  uint reserved;
};

/// What it finds.
struct ShadowProbeResult {
  float visibility;     // as shading gets it
  float region_width;   // of the blocker search, texels of mip 0
  float nearest;        // depth in that region
  float blocker_count;  // weighted
  float blocker_depth;  // mean
  float penumbra;       // width, texels of mip 0
  vec2 cookie;          // red, green
};

GLOAM_SHARED_END

#define GLOAM_SHADOW_PROBE_DIRECTIONAL 1
#define GLOAM_SHADOW_PROBE_SUBSURFACE 2
#define GLOAM_SHADOW_PROBE_GROUP 64  // threads of a workgroup

#endif
