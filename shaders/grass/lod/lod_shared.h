// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_LOD_LOD_SHARED_H
#define GLOAM_SHADERS_GRASS_LOD_LOD_SHARED_H

#include "shaders/common/prelude.h"

#define GLOAM_GRASS_CULLED 255u            // key of blades that are not drawn
#define GLOAM_GRASS_CLASSES 4              // draws of a view: near blades have more segments
#define GLOAM_GRASS_CAST_CLASS 2           // draw class whose segments blades in shadow maps have
#define GLOAM_GRASS_FEW_BLADES 64u         // patches with fewer blades cast the shadows of all, as wide as they are
#define GLOAM_GRASS_NOT_WIDER 0x80000000u  // flag of a listed caster: it is as wide as the blade
#define GLOAM_GRASS_DRAW_BLADES 32u        // blades of one instance of a draw

GLOAM_SHARED_BEGIN

/// Level of detail of one view. Lengths in metres; planes are those of the view in metres.
struct GrassLod {
  vec4 planes[5];         // camera-relative: a point p is inside if dot(xyz, p) + w >= 0
  float range_m;          // distance of key 255
  float pixel_m;          // size of a pixel at a distance of 1 m; of all pixels if orthographic
  uint orthographic;      // 0 or 1
  float width_px;         // least width of a blade's root to which the LOD thins and widens the field; 0: no thinning
  uint threshold;         // greatest key that is drawn, 0…254
  float cast_m;           // blades nearer than this stay although they are out of view: they may cast shadows into it
  uint cast_key;          // greatest key of blades that cast shadows; GLOAM_GRASS_CULLED: none do
  uint cast_every;        // of so many blades within cast_key one casts, as many times as wide; ≥ 1
  uint most_masters;      // that the dispatch of the simulation has room for
  float steps_per_s;      // of the simulation
  float units_per_metre;  // of the view
  float stride_px;       // a blade that is shorter than this in the picture runs two steps at once, one a third as long
                         // four; 0: none does
  uvec4 class_keys;      // greatest key of each draw class, rising; the last is 254
  uvec4 class_segments;  // segments of each blade of a class: 15, 5, 3 or 1
  uvec4 class_indices;   // first index of a class in the index buffer
};

/// Arguments of one indexed indirect draw.
struct GrassDraw {
  uint indices;
  uint instances;
  uint first_index;
  uint vertex_offset;
  uint first_instance;
};

/// Draws of a view, written by live.comp.
struct GrassDraws {
  GrassDraw draws[GLOAM_GRASS_CLASSES];
  uvec3 blade_groups;                     // workgroups with a thread for each live blade
  uint live;                              // blades that are drawn
  uint class_first[GLOAM_GRASS_CLASSES];  // in the sorted blades
  uint class_count[GLOAM_GRASS_CLASSES];
  uint cast_count;  // blades within cast_key
  float units_per_metre;
};

/// Blades that cast shadows: begun by live.comp, listed by pose.comp in any order, as places among the poses and flags.
struct GrassCasting {
  GrassDraw draw;
  uint count;
  float wider;   // factor of their width
  uint moved;    // not 0 if any of them has moved in its last steps, or has not been simulated
  uvec3 groups;  // workgroups with a thread for each of them
};
#define GLOAM_GRASS_PART_WORDS 64u  // distance between the GrassCasting of parts of faces (part_casters.comp), words

/// Masters that a frame simulates, written by live.comp and masters.comp.
struct GrassDispatch {
  uint masters;  // first, because the simulation binds the buffer as their number
  uvec3 groups;  // workgroups of the simulation
};

GLOAM_SHARED_END

#endif
