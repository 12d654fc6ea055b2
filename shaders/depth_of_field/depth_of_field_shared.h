// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_DEPTH_OF_FIELD_SHARED_H
#define GLOAM_SHADERS_DEPTH_OF_FIELD_DEPTH_OF_FIELD_SHARED_H

#include "shaders/common/prelude.h"

/// Side of a tile, in pixels of the picture.
#define GLOAM_DOF_TILE 16
/// Greatest value of dof.radius, in pixels of the picture.
#define GLOAM_DOF_MOST_RADIUS 31
/// Farthest texel that a kernel reads, and the tiles that it reaches at most. The round kernel is wider than its
/// circle.
#define GLOAM_DOF_MOST_TAPS 44
#define GLOAM_DOF_MOST_SPREAD 3
/// Threads of a workgroup that filters a line.
#define GLOAM_DOF_LINE 64
/// Side of a workgroup that filters a block of texels.
#define GLOAM_DOF_BLOCK 8
/// Most workgroups of an indirect dispatch along x.
#define GLOAM_DOF_ROW 32768

/// Lists of tiles, by what runs in them.
#define GLOAM_DOF_PREFILTER_FAR 0   // the far layer only
#define GLOAM_DOF_PREFILTER_BOTH 1  // the far and the near layer
#define GLOAM_DOF_FAR_FIRST 2       // passes of the far layer that later passes read in neighbouring texels
#define GLOAM_DOF_NEAR_FIRST 3
#define GLOAM_DOF_FAR_LAST 4  // the last pass of the far layer
#define GLOAM_DOF_NEAR_LAST 5
#define GLOAM_DOF_COMPOSE_FAR 6
#define GLOAM_DOF_COMPOSE_BOTH 7
#define GLOAM_DOF_BEYOND_FIRST 8  // as 3, of the light beyond
#define GLOAM_DOF_BEYOND_LAST 9   // tiles that show something before the focus near something else
#define GLOAM_DOF_LISTS 10

GLOAM_SHARED_BEGIN

/// Constants of one view. Layers are the images that are blurred: behind the focus (far) and before it (near).
struct DofConstants {
  uvec2 size;        // of the picture, pixels
  uvec2 layer_size;  // of a layer, texels
  uvec2 tiles;       // of GLOAM_DOF_TILE pixels
  vec2 inverse_size;
  // Radius of the circle of confusion in pixels, positive behind the focus: offset + slope · depth (of the depth
  // image).
  float coc_offset;
  float coc_slope;
  float radius;  // greatest radius, pixels
  float blend;   // pixels over which the picture passes from sharp to blurred
  float reach;   // radius of a kernel, as a multiple of the circle's
  int spread;    // tiles that a kernel of the greatest radius reaches
};

/// A list of tiles: arguments of an indirect dispatch with one workgroup for each, then their number.
struct DofList {
  uint groups_x;
  uint groups_y;
  uint groups_z;
  uint count;
};

GLOAM_SHARED_END

#endif
