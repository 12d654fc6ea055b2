// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_GBUFFER_SMOOTH_SURFACE_SHARED_H
#define GLOAM_SHADERS_RENDER_GBUFFER_SMOOTH_SURFACE_SHARED_H

#include "shaders/common/prelude.h"
#include "shaders/render/draw_shared.h"

GLOAM_SHARED_BEGIN

/// Push constants of one draw of smooth_surface.vert.
struct SmoothSurfaceConstants {
  DrawConstants draw;
  uint first_index;  // of the draw's triangles in mesh_indices
};

GLOAM_SHARED_END

#endif
