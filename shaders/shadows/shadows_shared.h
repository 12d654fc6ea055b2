// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_SHADOWS_SHADOWS_SHARED_H
#define GLOAM_SHADERS_SHADOWS_SHADOWS_SHARED_H

#include "shaders/common/prelude.h"

// Shadow maps hold reversed depth: near / depth in perspective faces, linear from 1 (near) to 0 (far) in faces of
// directional lights. Depth 0 means empty and never blocks. All faces of a view are in one atlas; each is a square
// whose side is a power of two and whose corner is a multiple of its side.
//
// The atlas image has 1.5 W × W texels. Mip 0 is the square [0, W)². Mip m ≥ 1 is the square of side W / 2^m with its
// corner at (W, W − W / 2^(m−1)). Mip m of a face of side s at `origin` is s / 2^m wide and begins at corner(m) +
// origin / 2^m. The pyramid image holds two images of the same layout for W / 4, one below the other; their level l
// belongs to mip l + GLOAM_SHADOW_PYRAMID_MIP. A texel of the upper one holds the nearest depth of the mip-0 texels
// that it covers, one of the lower one the farthest (0 when any of them is empty).
//
// The faces of a cube look along its axes +X, −X, +Y, −Y, +Z, −Z (GLOAM_CUBE_X …), in this order. The y axis of ±X and
// ±Z is +Y, that of +Y is −Z, that of −Y is +Z; the x axis is cross(forward, y axis). Texture coordinates of a face
// begin at its upper left corner: x runs along the x axis, y against the y axis.

// The axes of all cubes in the world. They are rotated, because edges of buildings run along the world's axes. In an
// unrotated face, an edge along a world axis runs along a row or column of texels; its position is then wrong by the
// same share of a texel everywhere, which no filter averages out. In a face that shows a world axis at length, the axis
// is at least 8° off the face's rows and columns. Each world axis is within 15° of a face's middle, where kernels are
// round.
#define GLOAM_CUBE_X vec3(0.96954172f, 0.18399011f, -0.16166783f)
#define GLOAM_CUBE_Y vec3(-0.15356032f, 0.97085883f, 0.18399011f)
#define GLOAM_CUBE_Z vec3(0.19080900f, -0.15356032f, 0.96954172f)

#define GLOAM_SHADOW_NONE 0
#define GLOAM_SHADOW_SPOT 1
#define GLOAM_SHADOW_CUBE 2
#define GLOAM_SHADOW_ROW_TEXELS 8  // texels of a light row
#define GLOAM_SHADOW_PYRAMID_MIP 2
#define GLOAM_SHADOW_MIPS_NEAREST 0  // a texel is the nearest of its four
#define GLOAM_SHADOW_MIPS_AVERAGE 1  // mean linear depth of the four, without empty ones
// Coverage mip: mean depth of the nearest surface; the 6 lowest bits count the 64ths of the texel that it leaves free
#define GLOAM_SHADOW_MIPS_COVERAGE 2
#define GLOAM_SHADOW_SMALLEST_FACE 16  // texels of a side; faces have 16 … 4096
#define GLOAM_MAX_CASCADES 4
#define GLOAM_MAX_DIRECTIONAL_SHADOWS 16
#define GLOAM_COOKIE_LIGHTS 4  // most lights with cookies that ShadowBlock lists

GLOAM_SHARED_BEGIN

/// Light row of a local light: GLOAM_SHADOW_ROW_TEXELS texels of an rgba32f image. Row number: index of the light in
/// the view.
struct ShadowRow {
  float kind;                // GLOAM_SHADOW_NONE, _SPOT or _CUBE
  float near_m;              // depth of the near plane; nearer surfaces neither block nor are in shadow
  float emitter_diameter_m;  // 0: hard shadows
  float size;                // texels of a face's side; all faces of the light have the same
  vec3 right;                // axes of the light's node in the world; for a spot those of its face
  float tan_half;            // tangent of half a face's field of view, with the rim
  vec3 up;
  float tan_inner;  // tangent of half the field of view without the rim; points beyond it belong to another face or to
                    // none
  vec2 origins[6];  // corners of the faces in the atlas, texels of mip 0; spot: only the first
  float cookie_layer;  // layer of the cookie images; −1: none
  float cookie_tan;    // tangent of the half angle that the cookie fills
  float traced_layer;  // layer of the traced visibility (kFilter 4); −1: always lit
  float mirrored;      // 1: mirrored node, the axes are left-handed, forward is cross(right, up); else 0
  vec4 reserved1;
};

/// One cascade of a directional light.
struct ShadowCascade {
  vec4 row_u;      // dot(row_u, (camera-relative position, 1)) = x: texels of mip 0 from the face's corner
  vec4 row_v;      // the same for y
  vec4 row_depth;  // the same for reversed depth, 1 … 0
  vec2 origin;     // corner in the atlas, texels of mip 0
  float size;      // texels of a side
  float texel_m;   // metres per texel
  float depth_m;   // metres from depth 1 to depth 0
  float rim;       // width of the rim, texels
  vec2 reserved;
};

/// Light row of one cascade; the values that all cascades of the light share are repeated in each row. An image,
/// because threads that evaluate different lights read texels faster than uniforms.
struct CascadeRow {
  ShadowCascade cascade;
  float cascade_count;     // cascades of the light; 0: it casts no shadow
  float penumbra_m_per_m;  // penumbra width per metre between blocker and receiver: 2 tan(angle / 2)
  float traced_layer;      // as ShadowRow::traced_layer
  float brightest;         // lux of the light's brightest channel
  vec3 direction;          // unit, the way the light shines
  float reserved0;
  vec4 reserved1;
};

struct DirectionalShadow {
  uint cascade_count;      // 0: it casts no shadow
  float penumbra_m_per_m;  // penumbra width per metre between blocker and receiver: 2 tan(angle / 2)
  float traced_layer;      // as ShadowRow::traced_layer
  float reserved;
  ShadowCascade cascades[GLOAM_MAX_CASCADES];  // from the camera outwards; the first one that contains a point counts
};

/// Shader constants of a view's shadows; uniform.
struct ShadowBlock {
  float atlas_size;     // W
  float bias_m;         // oriented bias; 0 with hardware bias
  float depth_quantum;  // smallest step of the atlas' format at depth d: max(depth_quantum, d · relative_quantum)
  float relative_quantum;
  uint cascade_row;                         // first CascadeRow in the image of rows; GLOAM_MAX_CASCADES rows per light
  uint cookie_lights[GLOAM_COOKIE_LIGHTS];  // indices of the view's local lights with cookies, else ~0; complete when
                                            // the scene has at most GLOAM_COOKIE_LIGHTS
  DirectionalShadow directional[GLOAM_MAX_DIRECTIONAL_SHADOWS];  // by index of the view's directional lights
};

GLOAM_SHARED_END

#define GLOAM_SHADOWS_SPOTS 1u
#define GLOAM_SHADOWS_CUBES 2u
#define GLOAM_SHADOWS_SUNS 4u
#define GLOAM_SHADOWS_ALL_KINDS 7u

#endif
