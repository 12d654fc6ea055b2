// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_LIGHTS_SHARED_H
#define GLOAM_SHADERS_LIGHTS_LIGHTS_SHARED_H

#include "shaders/common/prelude.h"

#define GLOAM_MAX_LOCAL_LIGHTS 1024
#define GLOAM_EMITTER_ROWS 256  // GLOAM_MAX_LOCAL_LIGHTS / 4
#define GLOAM_MAX_DIRECTIONAL_LIGHTS 16
#define GLOAM_LIGHT_GROUPS 32          // words of 32 lights in a mask, without the group word
#define GLOAM_MASK_WORDS 33            // words of a light mask: group word (which of the 32 words are not 0), 32 words
#define GLOAM_LIGHT_TILE 32            // side of a tile with a tile mask, in pixels
#define GLOAM_SHADOW_TILE 8            // side of a shadow tile, which has one light list, in pixels
#define GLOAM_TILE_GROUP 8             // side of a tile group in shadow tiles; a group has one group mask
#define GLOAM_NO_SLOT 0xFFFFFFFFu      // slot of a shadow tile whose list did not fit: it uses its group mask
#define GLOAM_EMPTY_Z_BIN 0x0000FFFFu  // begin 0xFFFF, end 0: no light

GLOAM_SHARED_BEGIN

/// A point or spot light, camera-relative.
struct LocalLight {
  vec3 position;
  float inverse_range_squared;  // 1 / m²
  vec3 color;                   // candela, linear
  float spot_scale;  // intensity factor = clamp(cos * scale + offset, 0, 1)²; a point light has scale 0 and offset 1
  vec3 direction;    // direction in which it shines, unit length
  float spot_offset;
};

struct DirectionalLight {
  vec3 color;            // lux, linear
  float apparent_angle;  // radians
  vec3 direction;        // direction in which it shines, unit length
  float half_angle;      // apparent radius in highlights, radians; 0: that of a point
};

/// Lights that may touch the view. Local lights are sorted by the nearest view depth of their bounds.
struct LightBlock {
  uint local_count;
  uint directional_count;
  uint reserved0;
  uint reserved1;
  DirectionalLight directional[GLOAM_MAX_DIRECTIONAL_LIGHTS];
  LocalLight local[GLOAM_MAX_LOCAL_LIGHTS];
  vec4 emitter_radius[GLOAM_EMITTER_ROWS];  // of highlights, metres, four lights an item; 0: a point
};

/// Layout of the view's light lists in their buffers. zBins: words [0, z_bin_count) are the standard set, the next
/// z_bin_count words the ranged set; a word is begin | end << 16, a range of sorted local lights. The bin of view depth
/// d is floor((d - z_near) · z_scale), clamped to the valid bins.
struct LightGrid {
  uvec2 tiles;       // number of shadow tiles
  uvec2 groups;      // number of tile groups
  uvec2 mask_tiles;  // number of tile masks, GLOAM_MASK_WORDS each
  uint local_count;
  uint z_bin_count;
  float z_near;        // metres
  float z_scale;       // bins per metre
  uint slot_capacity;  // capacity in list entries, a multiple of 3
  uint fixed_slots;    // fixed list entries per tile, a multiple of 3; 0: as many as the tile needs
};

/// Counters of the searches of one view, summed on the GPU. Tiles that show only sky are not counted.
struct LightCounters {
  uint slots;             // list entries requested, rounded up to 3 per tile; more than slot_capacity if lists overflow
  uint overflow_tiles;    // tiles without a list
  uint violations;        // lights of the accurate search that exceed a tile's entries: must be 0
  uint tiles;             // shadow tiles with a surface
  uint mask_lights;       // sum over tiles: lights in the tile mask of the parent 32×32 tile
  uint candidate_lights;  // lights of mask_lights within the zBins of the tile's depths
  uint approx_lights;     // lights of candidate_lights that touch the tile's froxel
  uint group_lights;      // sum over tiles: lights in the group mask
  uint accurate_lights;   // sum over tiles: lights whose volume contains a pixel of the tile
  uint farthest_depth;    // bits of the least depth value of a surface (reversed Z); 0x3F800000 if there is none
  uint culling_errors;    // with lights.check: (pixel, light) pairs where the light reaches the pixel but is not in the
                          // tile's list; must be 0
  uint reserved;
};

GLOAM_SHARED_END

#endif
