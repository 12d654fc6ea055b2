// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_REFLECTIONS_SHARED_H
#define GLOAM_SHADERS_REFLECTIONS_REFLECTIONS_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// Constants of all reflection passes of a view.
struct ReflectionConstants {
  uvec2 size;            // texels of the reflection images
  uint scale;            // pixels of the view per texel, along each side: 1 or 2
  uint first_candidate;  // 0…3: which pixel of a 2×2 block is looked at first
  // Screen space.
  float k1;           // linear samples = max(1, k1 · exp(−k2 · view depth))
  float k2;           // 1/m
  uint refine;        // binary search steps
  float reach_m;      // height above the reflecting surface up to which rays are followed
  float thickness_m;  // depth that surfaces are assumed to have behind their visible side
  // Glossy blur.
  float blur_scale;       // standard deviation of the core, texels, for spread 1 (per pixel roughness: and roughness 1)
  float blur_tail;        // standard deviation of the tail, as a multiple of the core's; 0: there is no tail
  float blur_tail_share;  // of the light, 0…1
  float blur_across;     // width of the blur along rows as a share of that along columns; per pixel roughness: at least
  uint pixel_roughness;  // 1: blur by the roughness of each surface; 0: one width for all, as in the paper
  uint blur_radius;      // most texels on each side, ≤ GLOAM_MOST_BLUR_RADIUS
  // Fog on the reflected path.
  vec4 fog_radiance;    // rgb, cd/m²
  float fog_density;    // 1/m
  float fog_sky_m;      // path length through the fog of rays that meet no surface
  uint centered;        // 1: a texel shows the middle of its block; 0: the block's first candidate
  float unit_m;         // scene_unit(): hit distances are stored in hundredths of it
  float capture_scale;  // from the light of captures to that of the view
};

/// Arguments of an indirect dispatch over the listed tiles: GLOAM_TILE_ROW workgroups wide, one per tile, and as high
/// as needed.
struct MirrorCommands {
  uint groups_x;
  uint groups_y;
  uint groups_z;
  uint count;  // tiles
};

/// Where the lists of tiles lie in their buffers.
struct MirrorLists {
  uint tiles;          // of the reflection images
  uint command_words;  // from a list's MirrorCommands to the next one's
  uint place_words;    // from a list's first place to the next one's
};

/// A reflection proxy as the view sees it. Positions are relative to the camera.
struct ProxyRow {
  vec3 center;
  float radius_m;  // of the bounding sphere
  vec3 normal;
  float opacity;  // factor of the captured alpha, 0…1; 0: the proxy is not shown
  vec3 to_u;      // dot(to_u, p − center): −1…1 on the proxy
  float layer;    // of the captured images
  vec3 to_v;
  float emission;  // layer of the part of the light that factors do not scale; −1: they scale all
  float factor;    // first of the proxy's factors; −1: all are 1
  vec4 lowest_y;   // heights of the receivers, relative to the camera: in one of four bands
  vec4 highest_y;
  float texel_m;  // size of a texel of mip 0
  uint room;      // 1: of a room that holds the camera, or of no room as the camera
};

/// The proxies of a view.
struct ProxyTileConstants {
  uint tiles;    // vertical screen tiles
  uint words;    // mask words of a tile
  uint proxies;  // rows
  uint probes;   // rows of cube probes
};

GLOAM_SHARED_END

// Flags of a tile of GLOAM_REFLECTION_GROUP texels' side.
#define GLOAM_TILE_MIRROR 1u       // holds a surface that mirrored images serve
#define GLOAM_TILE_BUMPY 2u        // whose shading normal is not vertical
#define GLOAM_TILE_STRONG 4u       // holds a surface that reflects strongly
#define GLOAM_FLAT_MIRROR 0.99999  // y of the shading normal from which on it counts as vertical

// Lists of tiles.
#define GLOAM_LIST_MIRRORS 0u
#define GLOAM_LIST_FLAT 1u    // of GLOAM_LIST_MIRRORS: not bumpy
#define GLOAM_LIST_BUMPY 2u   // the others of these
#define GLOAM_LIST_STRONG 3u  // those of GLOAM_LIST_MIRRORS among them
#define GLOAM_TILE_LISTS 4u

#define GLOAM_TILE_ROW 64
#define GLOAM_PROXY_CELLS 4  // cells along each side of a proxy's image that have a factor of their own
#define GLOAM_REFLECTION_GROUP 8
#define GLOAM_BLUR_GROUP 64         // texels of a row or column that a workgroup blurs
#define GLOAM_MOST_BLUR_RADIUS 128  // texels

#endif
