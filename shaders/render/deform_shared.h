// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_DEFORM_SHARED_H
#define GLOAM_SHADERS_RENDER_DEFORM_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// Push constants that deform one primitive of one instance. Offsets count elements of their buffers.
struct DeformConstants {
  uint vertex_count;
  uint first_joint;  // into the frame's joint matrices
  uint skinned;      // 0 or 1
  uint morph_targets;
  uint first_weight;       // into the frame's morph weights
  uint morph_has_normals;  // 0 or 1
};

GLOAM_SHARED_END

#endif
