// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_RENDER_DRAW_SHARED_H
#define GLOAM_SHADERS_RENDER_DRAW_SHARED_H

#include "shaders/common/prelude.h"

GLOAM_SHARED_BEGIN

/// Push constants of one draw: rows of the affine matrix from the mesh's space to camera-relative space.
struct DrawConstants {
  vec4 row0;
  vec4 row1;
  vec4 row2;
  uint flags;  // GLOAM_DRAW_… bits
};

/// Push constants of one draw with motion. The previous rows map the mesh's space to space relative to the previous
/// camera.
struct MotionDrawConstants {
  DrawConstants draw;
  vec4 previous_row0;
  vec4 previous_row1;
  vec4 previous_row2;
};

/// Constants of one material, in a uniform buffer (set 1, binding 0).
struct MaterialConstants {
  vec4 base_color;
  vec4 emissive_cutoff;   // rgb cd/m², alpha cutoff
  vec4 factors;           // metallic, roughness, normal scale, occlusion strength
  vec4 extras;            // subsurface 0 or 1, reflectivity (< 0: from metallic and roughness), square root of the
                          // extinction length in metres (0: no light passes), 0
  vec4 uv_transform[10];  // two rows (xyz) per texture: base, normal, metallic-roughness, occlusion, emissive; w of row
                          // 0: uv set
};

GLOAM_SHARED_END

// DrawConstants::flags
#define GLOAM_DRAW_MIRRORED 1u  // the matrix mirrors: front faces are clockwise
// Specialisation constant 0 of the surface shaders
#define GLOAM_SURFACE_BASE_TEXTURE 1u
#define GLOAM_SURFACE_NORMAL_TEXTURE 2u
#define GLOAM_SURFACE_METALLIC_ROUGHNESS_TEXTURE 4u
#define GLOAM_SURFACE_OCCLUSION_TEXTURE 8u
#define GLOAM_SURFACE_EMISSIVE_TEXTURE 16u
#define GLOAM_SURFACE_MASK 32u
#define GLOAM_SURFACE_DOUBLE_SIDED 64u
#define GLOAM_SURFACE_VERTEX_COLOR 128u
#define GLOAM_SURFACE_FLIPPED 1024u      // of double-sided surfaces: front faces are clockwise
#define GLOAM_SURFACE_FLAT 2048u         // shaded with the normals of the triangles, as they are drawn
#define GLOAM_SURFACE_CLIPPED 512u       // surfaces behind ViewConstants::clip_plane are not drawn
#define GLOAM_SURFACE_UV_TRANSFORM 256u  // some texture has a transform or uses the second uv set

#endif
