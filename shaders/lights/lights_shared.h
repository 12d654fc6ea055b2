// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_LIGHTS_SHARED_H
#define GLOAM_SHADERS_LIGHTS_LIGHTS_SHARED_H

#include "shaders/common/prelude.h"

#define GLOAM_MAX_LOCAL_LIGHTS 1024
#define GLOAM_MAX_DIRECTIONAL_LIGHTS 16
#define GLOAM_LIGHT_GROUPS 32  // words of 32 lights in a tile's mask; one more layer tells which words are not empty
#define GLOAM_MASK_WORDS 33  // of a light mask in a buffer: first which of the 32 words are not empty, then those words
#define GLOAM_LIGHT_TILE 32  // pixels along one side of a tile of the CPU's light masks
#define GLOAM_SHADOW_TILE 8  // pixels along one side of a shadow tile, which has a light list
#define GLOAM_TILE_GROUP \
  8  // shadow tiles along one side of a tile group, which shares a mask of the approximate search
#define GLOAM_NO_SLOT 0xFFFFFFFFu  // a shadow tile whose list found no room: its lights are those of its group's mask
#define GLOAM_EMPTY_Z_BIN 0x0000FFFFu  // begin 0xFFFF, end 0: no light

GLOAM_SHARED_BEGIN

/// A point or spot light, camera-relative.
struct LocalLight {
  vec3 position;
  float inverse_range_squared;
  vec3 color;        // candela, linear
  float spot_scale;  // strength = clamp(cos * scale + offset)²; a point light has 0 and 1
  vec3 direction;    // where it shines, unit
  float spot_offset;
};

struct DirectionalLight {
  vec3 color;            // lux, linear
  float apparent_angle;  // radians
  vec3 direction;        // where it shines, unit
  float reserved;
};

/// Lights that may touch the view: local ones ordered by nearest view depth of their bounds.
struct LightBlock {
  uint local_count;
  uint directional_count;
  uint reserved0;
  uint reserved1;
  DirectionalLight directional[GLOAM_MAX_DIRECTIONAL_LIGHTS];
  LocalLight local[GLOAM_MAX_LOCAL_LIGHTS];
};

/// How the view's light lists lie in their buffers. zBins: words [0, z_bin_count) are the standard set, the next
/// z_bin_count the ranged one; a word is begin | end << 16 of the sorted local lights. The bin of view depth d is (d -
/// z_near) · z_scale, clamped.
struct LightGrid {
  uvec2 tiles;       // shadow tiles
  uvec2 groups;      // tile groups
  uvec2 mask_tiles;  // tiles of the CPU's masks, each GLOAM_MASK_WORDS words
  uint local_count;
  uint z_bin_count;
  float z_near;        // metres
  float z_scale;       // bins a metre
  uint slot_capacity;  // list entries that fit, a multiple of 3
  uint fixed_slots;    // entries a tile gets whatever it needs, a multiple of 3; 0: as many as it needs
};

/// What the searches count in one view, added up by the GPU. Tiles of nothing but sky are not counted.
struct LightCounters {
  uint slots;             // list entries asked for, rounded up to 3 a tile: more than slot_capacity when lists overflow
  uint overflow_tiles;    // tiles without a list
  uint violations;        // lights that the accurate search found beyond a tile's entries: must be 0
  uint tiles;             // shadow tiles with a surface
  uint mask_lights;       // lights of their parent tile's mask, summed over tiles
  uint candidate_lights;  // of those, in the zBins of the tile's depths
  uint approx_lights;     // of those, touching the tile's froxel
  uint group_lights;      // in the mask of the tile's group
  uint accurate_lights;   // with a pixel of the tile in their volume
  uint farthest_depth;    // bits of the least depth value of a surface (reversed Z); 0x3F800000 without one
  uint culling_errors;  // with lights.check: (pixel, light) pairs in range whose light is not in the tile's list; must
                        // be 0
  uint reserved;
};

GLOAM_SHARED_END

#endif
