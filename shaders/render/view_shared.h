// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_VIEW_SHARED_H
#define GLOAM_SHADERS_RENDER_VIEW_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// One view of one frame. Positions are relative to the camera, axes are the world's.
struct ViewConstants {
  mat4 clip_from_relative;
  mat4 relative_from_clip;
  vec4 view_row_z;      // dot(xyz, p) = z of p in view space (negative in front of the camera)
  uvec2 size;           // pixels
  vec2 inverse_size;
  float near_m;
  uint orthographic;    // 0 or 1
  uint frame;
  uint visualizer;
};

GLOAM_SHARED_END

#endif
