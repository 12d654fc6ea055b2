// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_LIT_TILES_SHARED_H
#define GLOAM_SHADERS_LIGHTING_LIT_TILES_SHARED_H

#include "shaders/common/prelude.h"

// Steps of lit_tiles.comp.glsl.
#define GLOAM_LIT_TILES_START 0
#define GLOAM_LIT_TILES_COMPARE 1
#define GLOAM_LIT_TILES_JOIN 2
#define GLOAM_LIT_TILES_CHOOSE 3
#define GLOAM_LIT_RUN_TILES 512  // the longest run; runs begin anew at its multiples

// A run of changed tiles in one row is one word: the row (11 bits), the first tile (11 bits), and the number of tiles
// less one (10 bits).

GLOAM_SHARED_BEGIN

/// Arguments of the draws that light a view with lighting.reuse=exact, and counts.
struct LitTileCommands {
  uvec4 tiles;   // 6 vertices, one instance per run of changed tiles, 0, 0
  uvec4 whole;   // 3 vertices, 1 instance if that costs less than the runs, 0, 0
  uvec4 counts;  // tiles with a list and a surface; those of them that have changed; runs of these; 0
};

struct LitTileConstants {
  uvec2 inputs;  // hash of what all tiles are lit by
  uvec2 size;    // pixels of the view
  uint kept;     // 0: there are no keys and no light of an earlier frame
  uint step;     // GLOAM_LIT_TILES_…
};

GLOAM_SHARED_END

#endif
