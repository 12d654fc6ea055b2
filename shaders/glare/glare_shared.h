// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GLARE_GLARE_SHARED_H
#define GLOAM_SHADERS_GLARE_GLARE_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// Texels of a level beyond each edge of the picture.
#define GLOAM_GLARE_MARGIN 2

/// The most light of a texel: what half floats hold. Sums of rounded values may exceed it.
#define GLOAM_GLARE_MOST_LIGHT 65504.0

/// Constants of the pass that collects a picture's light in cells (shaders/glare/collect.comp.glsl).
struct GlareCollect {
  ivec2 size;       // pixels of the picture
  ivec2 corners;    // of the cells
  vec2 origin;      // pixels, of the first corner
  float cell;       // pixels, side of a cell, at least 1
  int most_pixels;  // along a side of the area between four cells' centres
};

/// Constants of passes over the texels of one level.
struct GlareLevel {
  ivec2 size;         // texels
  vec2 inverse_from;  // 1 / texels of the level that is read
  float weight;       // share of this level in the spread
};

/// Constants of the pass that adds the scattered light to a picture (shaders/glare/show.comp.glsl).
struct GlareShow {
  vec2 uv_scale;  // from pixels to the spread image
  vec2 uv_offset;
  uvec2 size;  // pixels
  float share;
};

GLOAM_SHARED_END

#endif
