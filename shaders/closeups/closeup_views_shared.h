// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_CLOSEUPS_CLOSEUP_VIEWS_SHARED_H
#define GLOAM_SHADERS_CLOSEUPS_CLOSEUP_VIEWS_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// A pair of a subject and a light as the views of close-ups show it.
struct ShownCloseup {
  vec3 origin;     // of its face, camera-relative
  float tan_half;  // 0: orthographic
  vec3 right;
  float half_extent_m;  // orthographic
  vec3 up;
  float near_m;
  vec3 forward;
  float far_m;
  vec3 color;  // linear
  float size;  // texels of the face's side
  uvec2 first_tile;
  uvec2 end_tile;
  vec2 lines_low;  // of what its lines touch, pixels
  vec2 lines_high;
  uint first_line;
  uint line_count;
};

/// A straight line over the picture. Places are in pixels from the upper left corner, depths are reversed and run
/// evenly along it.
struct CloseupLine {
  vec2 from;
  vec2 to;
  float from_depth;
  float to_depth;
};

GLOAM_SHARED_END

/// Pixels from a line's middle to where it ends, its softened rim included.
#define GLOAM_CLOSEUP_LINE_REACH 1.25f

#endif
