// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOWS_SHARED_H
#define GLOAM_SHADERS_SHADOWS_SHADOWS_SHARED_H

#include "shaders/common/prelude.h"

// Shadow maps hold reversed depth: near / depth in perspective faces, 1 (near) to 0 (far) in a directional light's; 0
// is "empty" and never blocks. All faces of a view lie in one atlas, each a square whose side is a power of two and
// whose corner is a multiple of its side.
//
// The atlas image is 1.5 W × W texels: mip 0 is the square [0, W)², mip m ≥ 1 the square of side W / 2^m with its
// corner at (W, W − W / 2^(m−1)): a face of side s at `origin` has its mip m at corner(m) + origin / 2^m, s / 2^m wide.
// The pyramid image is two of the same layout for W / 4, one below the other: level l is mip l +
// GLOAM_SHADOW_PYRAMID_MIP. The upper one holds the nearest depth of the texels below, the lower one the farthest (0
// when one of them is empty).
//
// A cube's faces look along its own +X, −X, +Y, −Y, +Z, −Z (GLOAM_CUBE_X …); the y axis of ±X and ±Z is +Y, of +Y it is
// −Z, of −Y it is +Z; the x axis is cross(forward, y axis). Texture coordinates of a face run from its upper left
// corner: x along the x axis, y against the y axis.

// A cube's axes in the world. They are turned: edges of buildings run along the world's axes, and in a face that has
// the same axes they would run along columns of texels and be off by the same share of a texel everywhere, which no
// filter evens out. No axis of the world is less than 8° from the rows and columns of a face that shows it at length,
// and each is within 15° of the middle of a face, where kernels are round.
#define GLOAM_CUBE_X vec3(0.96954172f, 0.18399011f, -0.16166783f)
#define GLOAM_CUBE_Y vec3(-0.15356032f, 0.97085883f, 0.18399011f)
#define GLOAM_CUBE_Z vec3(0.19080900f, -0.15356032f, 0.96954172f)

#define GLOAM_SHADOW_NONE 0
#define GLOAM_SHADOW_SPOT 1
#define GLOAM_SHADOW_CUBE 2
#define GLOAM_SHADOW_ROW_TEXELS 8  // of a local light's ShadowRow in the image of rows
#define GLOAM_SHADOW_PYRAMID_MIP 2
#define GLOAM_SHADOW_MIPS_NEAREST 0  // a mip's texel is the nearest of its four
#define GLOAM_SHADOW_MIPS_AVERAGE 1  // their mean by linear depth, empty ones left out
#define GLOAM_SHADOW_MIPS_COVERAGE \
  2  // mean depth of the nearest surface, and in the 6 lowest bits how many 64ths of the texel that surface leaves free
#define GLOAM_SHADOW_SMALLEST_FACE 16  // texels; faces are 16 … 4096
#define GLOAM_MAX_CASCADES 4
#define GLOAM_MAX_DIRECTIONAL_SHADOWS 16
#define GLOAM_COOKIE_LIGHTS 4  // that ShadowBlock names

GLOAM_SHARED_BEGIN

/// How one local light casts shadows: GLOAM_SHADOW_ROW_TEXELS texels of an rgba32f image, row = index of the light in
/// the view.
struct ShadowRow {
  float kind;      // GLOAM_SHADOW_…
  float near_m;    // what is nearer to the light than this, along a face's axis, neither blocks nor is in shadow
  float width_m;   // diameter of the emitter; 0: hard shadows
  float size;      // texels of a face's side
  vec3 right;      // spot: the face's axes, world
  float tan_half;  // tangent of half a face's field of view, with the rim for kernels
  vec3 up;
  float tan_inner;     // the same without the rim: what lies beyond it belongs to another face, or to none
  vec2 origins[6];     // of faces in the atlas, texels of mip 0; spot: the first
  float cookie_layer;  // of the cookie images; −1: none
  float cookie_tan;    // tangent of the half angle that the cookie fills
  float traced_layer;  // of the traced visibility images (GLOAM_SHADOWS_FILTER_ID 4); −1: always lit
  float
      mirrored;  // 1: right and up are left-handed (a mirrored node's), the light looks along cross(right, up); else 0
  vec4 reserved1;
};

/// One box of a directional light's shadow.
struct ShadowCascade {
  vec4 row_u;      // dot(row, (camera-relative position, 1)): texels of mip 0 from the face's corner, x
  vec4 row_v;      // y
  vec4 row_depth;  // reversed depth, 1 … 0
  vec2 origin;     // in the atlas, texels of mip 0
  float size;      // texels
  float texel_m;   // metres a texel
  float depth_m;   // metres from depth 1 to depth 0
  float rim;       // texels at each side that only kernels look at
  vec2 reserved;
};

/// One cascade as GLOAM_SHADOW_ROW_TEXELS texels of the image of rows, with what its light's cascades have in common:
/// threads that look at different lights read texels faster than constants.
struct CascadeRow {
  ShadowCascade cascade;
  float cascade_count;     // of the light; 0: casts none
  float penumbra_m_per_m;  // width of the penumbra a metre between blocker and receiver: 2 tan(angle / 2)
  float traced_layer;      // as a local light's
  float brightest;         // lux, of the light's brightest component
  vec3 direction;          // where the light shines
  float reserved0;
  vec4 reserved1;
};

struct DirectionalShadow {
  uint cascade_count;      // 0: casts none
  float penumbra_m_per_m;  // width of the penumbra a metre between blocker and receiver: 2 tan(angle / 2)
  float traced_layer;      // as a local light's
  float reserved;
  ShadowCascade cascades[GLOAM_MAX_CASCADES];  // from the camera outwards; a point belongs to the first it lies in
};

/// Constants of all of a view's shadows.
struct ShadowBlock {
  float atlas_size;     // W
  float bias_m;         // oriented bias
  float depth_quantum;  // of the atlas' format at depth d: max(depth_quantum, d · relative_quantum)
  float relative_quantum;
  uint cascade_row;  // of the image of rows, where CascadeRow begin: GLOAM_MAX_CASCADES a directional light
  uint cookie_lights[GLOAM_COOKIE_LIGHTS];  // of the view, with cookies, while the scene has no more of them; else and
                                            // beyond: no light's index
  DirectionalShadow directional[GLOAM_MAX_DIRECTIONAL_SHADOWS];  // by index of the view's directional lights
};

GLOAM_SHARED_END

// Specialisation constants of shaders that include shadows_api.glsl
#define GLOAM_SHADOWS_FILTER_ID \
  8  // 0 hard, 1 pcf, 2 pcss, 3 chs, 4 what was traced (references), 5 none: cookies alone
#define GLOAM_SHADOWS_KERNEL_ID 9           // 4, 8, 12, 16 texels
#define GLOAM_SHADOWS_MIPS_ID 10            // 0 off, 1 on
#define GLOAM_SHADOWS_RECEIVER_PLANE_ID 11  // 0, 1
#define GLOAM_SHADOWS_BIAS_ID 12            // 0 hardware (in the map already), 1 oriented
#define GLOAM_SHADOWS_KERNEL_SHAPE_ID 13    // 0 disc, 1 square
#define GLOAM_SHADOWS_LEVELS_ID 14          // steps of visibility: 255 or 15; 0: not quantised
#define GLOAM_SHADOWS_FULL_PENUMBRA_ID 15   // 1: no early-outs, for measuring the filter alone
#define GLOAM_SHADOWS_KINDS_ID 16           // kinds of lights that are asked about: GLOAM_SHADOWS_SPOTS | …
#define GLOAM_SHADOWS_COVERAGE_ID \
  17  // 1: maps hold what a texel's nearest surface leaves free (GLOAM_SHADOW_MIPS_COVERAGE)

#define GLOAM_COOKIE_LIGHTS_ID \
  18  // lights with cookies that shaders look up first; more than GLOAM_COOKIE_LIGHTS: none (arriving_light.glsl)

#define GLOAM_SHADOWS_SPOTS 1u
#define GLOAM_SHADOWS_CUBES 2u
#define GLOAM_SHADOWS_SUNS 4u
#define GLOAM_SHADOWS_ALL_KINDS 7u

#endif
