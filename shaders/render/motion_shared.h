// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_MOTION_SHARED_H
#define GLOAM_SHADERS_RENDER_MOTION_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// Motion of a view's camera since the previous frame (RenderView::previous).
struct MotionConstants {
  mat4 previous_clip_from_relative;  // from positions relative to the previous camera
  vec3 moved;                        // camera position now minus previous camera position, metres, world axes
  vec2 half_size;                    // half the picture in pixels, y negative: pixels per unit of clip x/w and y/w
  uint orthographic;                 // 1: the current or the previous camera is orthographic
};

GLOAM_SHARED_END

#endif
