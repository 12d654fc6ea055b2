// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_CLOSEUPS_CLOSEUP_VIEWS_SHARED_H
#define GLOAM_SHADERS_CLOSEUPS_CLOSEUP_VIEWS_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// A close-up pair as the visualizers read it.
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
  float size;  // side of the face in texels
  uvec2 first_tile;
  uvec2 end_tile;
  vec2 lines_low;  // bounding rectangle of its lines, pixels
  vec2 lines_high;
  uint first_line;
  uint line_count;
};

/// A straight line over the picture. Positions are in pixels from the upper left corner; depths are reversed and linear
/// along the line.
struct CloseupLine {
  vec2 from;
  vec2 to;
  float from_depth;
  float to_depth;
};

GLOAM_SHARED_END

/// Half width of a line in pixels, including its softened edge.
#define GLOAM_CLOSEUP_LINE_REACH 1.25f

#endif
