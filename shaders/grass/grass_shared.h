// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_GRASS_SHARED_H
#define GLOAM_SHADERS_GRASS_GRASS_SHARED_H

#include "shaders/common/prelude.h"

// Blades of grass: a stem of 16 knots on each. Knots of masters are simulated; slaves copy their master's. Positions of
// a patch are relative to its origin, so that they are exact far from the world's origin, and along its axes, which
// turn with the ground.

#define GLOAM_GRASS_KNOTS 16
#define GLOAM_GRASS_PATCH_BLADES 256     // slots of a patch; the last ones may be empty
#define GLOAM_GRASS_TYPES 16             // most blade types of a field
#define GLOAM_GRASS_COLORS 16            // procedural colours of blades without an image
#define GLOAM_GRASS_NO_STEP 0xFFFFFFFFu  // step stamp of a master whose knots hold nothing

GLOAM_SHARED_BEGIN

/// One blade, packed (pack_blade_row). Its index is 256 · patch + index in the patch; masters come first.
struct GrassBladeRow {
  uint root_xz;        // root in the box of the patch: unorm16 x, unorm16 z << 16
  uint root_y_normal;  // unorm16 y, octahedral ground normal: snorm8 << 16, snorm8 << 24
  uint size;           // packHalf2x16(length_m, width_m)
  uint kind;           // yaw: unorm8 of a turn; type << 8 (4 bits); layer << 12 (4 bits); master's index in the patch
                       // << 16; rank: unorm8 << 24
};

/// Shape of one blade type.
struct GrassTypeRow {
  vec2 stem[GLOAM_GRASS_KNOTS];  // knots at rest, forward and up, for a length of 1; knot 0 is (0, 0)
  float stiffness;               // 0…1: limp to stiff
  float damping;                 // 1/s: a swing falls to 1/e in 1 s over damping
  float taper;                   // width at the tip over width at the root
};

/// One patch that is drawn or simulated in this frame.
struct GrassPatchRow {
  vec3 origin;         // camera-relative position of the patch's origin, metres
  vec4 turn;           // quaternion (x, y, z, w) from the patch's axes to the world's; 0: none
  vec4 previous_turn;  // in the frame before
  vec3 carried;        // way of the origin since the frame before
  vec3 push;           // acceleration of the blades against that of the ground, m/s², in the world
  vec3 box_from;       // box of the roots, relative to the origin, along the patch's axes
  vec3 box_size;
  vec3 wind_at;         // position of the origin in the wind's field, metres, 0…GLOAM_GRASS_WIND_PERIOD
  uint first_blade;     // in the blade rows
  uint blades;          // ≤ 256
  uint first_place;     // the patch's first master in stamps; its knots begin at 16 · place
  uint first_collider;  // in the colliders
  uint colliders;
  float max_distance_m;  // range of the 8-bit keys
  uint texture;          // its blades' image: first layer of the array | layers << 16; 0: procedural colours
};

/// One collider near one patch. Positions are relative to the patch's origin and along its axes, at the begin and the
/// end of the frame's steps. A sphere is a capsule whose ends coincide.
struct GrassCollider {
  vec3 from;  // capsule: one end of its axis; box: its centre
  vec3 from_previous;
  vec3 to;  // capsule: the other end of its axis
  vec3 to_previous;
  vec3 axis_x;  // box: unit axes
  vec3 axis_y;
  vec3 axis_z;
  vec3 half_size;  // box, metres
  float radius_m;  // capsule
  uint box;        // 0: capsule, 1: box
};

/// The wind over the whole field. wind_velocity() evaluates it.
struct GrassWind {
  vec3 velocity;  // m/s
  float gust;     // 0…1
  vec3 drift;     // distance that gusts have travelled at step `first_step`, metres, 0…GLOAM_GRASS_WIND_PERIOD
};
#define GLOAM_GRASS_WIND_PERIOD 256.0

/// Constants of the simulation.
struct GrassSteps {
  GrassWind wind;
  float step_s;      // length of a step
  uint now;          // number of the step that all simulated blades reach in this frame
  uint frame_steps;  // steps that this frame advances; blades that slept do at most that many
  uint iterations;   // of constraints in each step, 1…64
  uint moves;        // 1: blades that have reached `now` have moved since the frame before
};

/// One master that a frame simulates.
struct GrassMaster {
  uint blade;   // patch row << 8 | index in the patch
  uint steps;   // to run; GLOAM_GRASS_NO_STEP: put the knots at rest first, then run GrassSteps::frame_steps
  uint stride;  // a far master runs steps of this many at once; 0 is 1
};
#define GLOAM_GRASS_MOST_STRIDE 4  // a power of two

GLOAM_SHARED_END

#endif
