// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_DEPTH_OF_FIELD_DEPTH_OF_FIELD_SHARED_H
#define GLOAM_SHADERS_DEPTH_OF_FIELD_DEPTH_OF_FIELD_SHARED_H

#include "shaders/common/prelude.h"

/// Side of a tile, in pixels of the picture.
#define GLOAM_DOF_TILE 16
/// Levels of the layers. A texel of level k has 2^k × 2^k pixels.
#define GLOAM_DOF_LEVELS 5
/// Circles before the focus are blurred at the level of circles this many times smaller: the edges of the near layer
/// show more than those of the far one.
#define GLOAM_DOF_NEAR_FINER 2.0
/// Side of the block of texels that a workgroup with workgroup memory keeps: a tile and the texels around it that
/// kernels read. 16 KiB hold all of it.
#define GLOAM_DOF_ROOM 28
/// Farthest texel that a kernel of the coarsest level reads: its tiles have one texel.
#define GLOAM_DOF_MOST_TAPS 13
/// Threads of a workgroup that runs over a tile. On lavapipe, where they run one after another, each loads what they
/// share, so few are faster.
#define GLOAM_DOF_THREADS 64
#define GLOAM_DOF_THREADS_IN_TURN 8
/// A gather's work: the greatest square of the distance of a texel that a kernel reads, then the same of texels that
/// fill in the far layer behind pixels before the focus, times GLOAM_DOF_FILLS; 0: there are no such pixels.
#define GLOAM_DOF_FILLS 256
#define GLOAM_DOF_EMPTY 65536  // the tile's texels are set to zero
/// What a prefilter writes: bits. A tile without circles before the focus has zeros in the near layer.
#define GLOAM_DOF_WANTS_FAR 1
#define GLOAM_DOF_WANTS_NEAR 2
#define GLOAM_DOF_HAS_NEAR 4
/// Most workgroups of an indirect dispatch along x.
#define GLOAM_DOF_ROW 32768
/// Most sprites that start in a tile. A tile with more bright pixels has none: they stay in the layers.
#define GLOAM_DOF_TILE_SPRITES 40
/// Most sprites that reach a tile.
#define GLOAM_DOF_REACHING_SPRITES 144

/// Lists of tiles, by the pass that runs in them. Of the first ones there is one for each level: list + level.
#define GLOAM_DOF_PREFILTER 0       // tiles without sprites and without pixels before the focus
#define GLOAM_DOF_PREFILTER_MORE 5  // other tiles
#define GLOAM_DOF_FAR 10            // gathers of the far layer
#define GLOAM_DOF_NEAR 15           // gathers of the near layer
#define GLOAM_DOF_COMPOSE 20        // + what is composed
// What is composed in a tile. Fine levels are 0 and 1.
#define GLOAM_DOF_COMPOSE_ONE 0         // + level: one level of the far layer, not 0
#define GLOAM_DOF_COMPOSE_TWO 5         // + level: two coarse levels of the far layer, this and the next
#define GLOAM_DOF_COMPOSE_FAR 10        // any levels of the far layer
#define GLOAM_DOF_COMPOSE_NEAR_FINE 11  // fine levels of the near layer
#define GLOAM_DOF_COMPOSE_NEAR 12       // any levels of the near layer
#define GLOAM_DOF_COMPOSE_BOTH 13       // any levels of both
#define GLOAM_DOF_COMPOSE_SPRITES 14    // these and sprites
#define GLOAM_DOF_COMPOSE_KINDS 15
// These only count.
#define GLOAM_DOF_NEAR_TILES 35  // tiles that the near layer reaches
#define GLOAM_DOF_COARSER 36     // tiles with circles greater than dof.radius
#define GLOAM_DOF_SPRITES 37     // sprites
#define GLOAM_DOF_OVERFLOW 38  // tiles with more bright pixels than sprites, and tiles that more sprites reach than fit
#define GLOAM_DOF_LISTS 39

GLOAM_SHARED_BEGIN

/// Constants of one view. Layers are the images that are blurred: what lies before the focus (near) and all else (far).
/// All levels of a layer lie in one image.
struct DofConstants {
  uvec2 size;   // of the picture, pixels
  uvec2 tiles;  // of GLOAM_DOF_TILE pixels
  vec2 inverse_size;
  vec2 inverse_layers;  // 1 / size of the image of all levels of a layer
  // Radius of the circle of confusion in pixels, positive behind the focus: offset + slope · depth (of the depth
  // image).
  float coc_offset;
  float coc_slope;
  float radius;  // greatest radius, pixels; larger ones count as that
  float limit;   // greatest radius that does not count as coarser, pixels
  // Where circles pass from level k to level k + 1: radii in pixels.
  float from[GLOAM_DOF_LEVELS];
  float to[GLOAM_DOF_LEVELS];
  ivec2 corner[GLOAM_DOF_LEVELS];         // of a level in the image of all levels
  int taps[GLOAM_DOF_LEVELS];             // the farthest texel that a kernel of the level reads
  int prefilter_tiles[GLOAM_DOF_LEVELS];  // of a workgroup of the prefilter
  int gather_tiles[GLOAM_DOF_LEVELS];     // of a workgroup of the gathers
  int first_level;
  int last_level;
};

/// A list of tiles: arguments of an indirect dispatch, then their number.
struct DofList {
  uint groups_x;
  uint groups_y;
  uint groups_z;
  uint count;
};

/// A tile of a list.
struct DofEntry {
  uint place;  // x | y << 16
  int work;    // of gathers: GLOAM_DOF_FILLS and so on; of prefilters: GLOAM_DOF_WANTS_FAR and so on
};
/// Push constants of the passes over the tiles of one level.
struct DofLevel {
  int level;
};

/// Circles of the pixels of a tile. Masks: bit k for level k.
struct DofTileBounds {
  uint far;           // levels of pixels behind the focus
  uint near;          // levels of pixels before the focus
  uint fill;          // levels at which the far layer is filled in behind them
  float least_near;   // least radius before the focus; 0: some pixels are not before the focus
  float far_radius;   // greatest radius behind the focus, pixels; 0: none
  float near_radius;  // greatest radius before the focus, pixels; 0: none
};

/// Circles of the whole picture: of all tiles together.
struct DofPictureBounds {
  uint far_levels;
  uint near_levels;
  uint near_radius;  // bits of the float
  uint radius;       // greatest on both sides of the focus, bits of the float
};

/// The blur of a tile.
struct DofTileReach {
  uint far;           // levels of the far layer that are composed
  uint near;          // levels of the near layer that reach the tile
  float near_radius;  // greatest radius of circles before the focus that reach the tile, pixels
};

/// Light of pixels of a block of 2 × 2, or of 4 × 4 where circles are wide, that are much brighter than
/// their surroundings, without the share that stays in the layers.
struct DofSprite {
  vec2 place;  // centre of the light, pixels; the middle of the first pixel is 0
  float coc;   // radius in pixels, positive behind the focus
  float soft;  // width of the disc's edge in pixels: that of the light's pixels together
  vec3 light;
};

/// Bright pixels of a tile.
struct DofTileSprites {
  uint count;
  float surroundings;  // light that a bright pixel leaves to the layers; < 0: the tile has no sprites
};

GLOAM_SHARED_END

#endif
