// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_REPROJECT_SHARED_H
#define GLOAM_SHADERS_SHADOWS_REPROJECT_SHARED_H

#include "shaders/common/prelude.h"
#include "shaders/render/view_shared.h"

#define GLOAM_MOST_MOVED_CASTERS 64
// In place of the source of a pixel: it is not found, or the pixel shows no surface.
#define GLOAM_NO_SOURCE 0xFFFFFFFFu
#define GLOAM_NO_SURFACE 0xFFFFFFFEu

GLOAM_SHARED_BEGIN

/// What find_sources.comp.glsl and reproject.glsl need besides the buffers of the frame before.
struct ReprojectBlock {
  ViewConstants last;  // of the frame before
  vec3 moved;          // camera position now minus that of the frame before, metres, world axes
  uint turned_on;      // 0: nothing is reprojected, this frame only leaves its pixels for the next one
  uint phase;          // 0 … 3: the quarter of the tiles that is made anew
  uint sphere_count;
  vec4 spheres[GLOAM_MOST_MOVED_CASTERS];  // around casters that have moved, where they were and where they are:
                                           // camera-relative centre, radius
};

GLOAM_SHARED_END

#endif
