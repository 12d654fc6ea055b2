// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_PROBES_SHARED_H
#define GLOAM_SHADERS_LIGHTING_PROBES_SHARED_H

#include "shaders/common/prelude.h"

#define GLOAM_FEW_PROBES 6
#define GLOAM_PROBE_CELLS 16  // cells along each side of a probe's map that have a factor of their own

GLOAM_SHARED_BEGIN

/// A cube probe as the view sees it.
struct ProbeRow {
  vec3 center;  // relative to the camera
  float layer;
  vec3 to_x;   // dot(to_x, p − center): −1…1 inside the influence box
  float fade;  // share of the half size over which the influence fades toward the faces
  vec3 to_y;
  float global;  // 1: without a box
  vec3 to_z;
  float emission;  // layer of the part of the light that factors do not scale; −1: they scale all
  float factor;    // first of the probe's factors; −1: all are 1
};

/// What surfaces mirror of their surroundings, besides sky and ground.
struct SurroundingsConstants {
  ProbeRow few_probes[GLOAM_FEW_PROBES];  // the first rows
  vec3 fog_light;                         // fog before all that is mirrored, times light_scale
  float fog_through;                      // share of the mirrored light that passes it
  uint probes;                            // rows
  float probe_scale;                      // from the light of the probes' images to that of the view
};

GLOAM_SHARED_END

#endif
