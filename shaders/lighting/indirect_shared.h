// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_INDIRECT_SHARED_H
#define GLOAM_SHADERS_LIGHTING_INDIRECT_SHARED_H

#include "shaders/common/prelude.h"
#include "shaders/lighting/probes_shared.h"

#define GLOAM_DIFFUSE_TERMS 9  // spherical harmonics of order 2

GLOAM_SHARED_BEGIN

/// Diffuse light of a cube probe: its box, and a polynomial in the normal that is the mean radiance, weighted by the
/// cosine, of the hemisphere around it. Terms are those of diffuse_terms() in indirect_api.glsl; w is not used.
struct DiffuseProbe {
  ProbeRow row;
  vec4 terms[GLOAM_DIFFUSE_TERMS];
  // Of a probe without a box, otherwise 0 (modules/reflections/diffuse/neighbourhood.h).
  float open;              // greatest share that sky and ground take far from it
  float per_square_reach;  // 1 / reach²
};

/// Diffuse light of all probes of a view.
struct IndirectConstants {
  DiffuseProbe few_probes[GLOAM_FEW_PROBES];  // the first rows
  uint probes;                                // rows
};

GLOAM_SHARED_END

#endif
