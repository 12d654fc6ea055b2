// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/drawing/pose_shared.h"
#include "shaders/grass/lod/lod_api.glsl"
#include "shaders/grass/simulation/slave_api.glsl"
#include "shaders/grass/way_api.glsl"

// Poses of the live blades, in sorted order, and the list of those that cast shadows. One thread per blade.

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) uniform Lod { GrassLod lod; };
layout(set = 0, binding = 1, scalar) readonly buffer Patches { GrassPatchRow patches[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Rows { GrassBladeRow blade_rows[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Types { GrassTypeRow types[]; };
layout(set = 0, binding = 4, scalar) readonly buffer Blades { uint blades[]; };  // sorted
layout(set = 0, binding = 5, scalar) readonly buffer Draws { GrassDraws draws; };
layout(set = 0, binding = 6, scalar) readonly buffer Knots { vec4 knots[]; };
layout(set = 0, binding = 7, scalar) readonly buffer PreviousKnots { vec4 previous_knots[]; };
layout(set = 0, binding = 9, scalar) readonly buffer Stamps { uint stamps[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer Poses { GrassPose poses[]; };
layout(set = 0, binding = 10, scalar) buffer Casting { GrassCasting casting; };
layout(set = 0, binding = 11, scalar) writeonly buffer Casters {
  uint casters[];
};  // places among the poses, GLOAM_GRASS_NOT_WIDER

// Rotation and scale from the knots of the master to those of the blade, relative to their roots.
mat3 turn_of(GrassStem master, GrassStem blade, uint slot, uint first_knot, uint master_type) {
  const uint tip = uint(GLOAM_GRASS_KNOTS) - 1u;
  vec3 tip_at = knots[first_knot + tip].xyz;
  float speed = length(tip_at - previous_knots[first_knot + tip].xyz) * lod.steps_per_s;
  return slave_turn(master, blade, slot, tip_at - master.root, grass_rest(master, types[master_type].stem[tip]), speed);
}

// Whether a master has moved in its last steps.
bool has_moved(uint first_knot) {
  const uint tip = uint(GLOAM_GRASS_KNOTS) - 1u;
  vec3 sum = vec3(0.0);
  for (uint k = tip; k >= 5u; k -= 5u)
    sum += abs(unpack_way(vec2(knots[first_knot + k].w, previous_knots[first_knot + k].w)));
  return sum != vec3(0.0);
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= draws.live) return;
  uint slot = blades[i] % GLOAM_GRASS_PATCH_BLADES;
  GrassPatchRow row = patches[blades[i] / GLOAM_GRASS_PATCH_BLADES];
  GrassBladeRow packed_blade = blade_rows[row.first_blade + slot];
  uint master_slot = grass_master(packed_blade);
  GrassBladeRow packed_master = blade_rows[row.first_blade + master_slot];
  GrassStem blade = grass_stem(row, packed_blade), master = grass_stem(row, packed_master);
  uint first_knot = GLOAM_GRASS_KNOTS * (row.first_place + master_slot);
  mat3 turn = turn_of(master, blade, slot, first_knot, grass_type(packed_master));
  turn = slot == master_slot ? mat3(1.0) : turn;

  vec3 root = grass_turned(row.turn, blade.root);
  float distance_m = length(row.origin + root);
  float share = grass_share(lod, blade.width_m, distance_m);
  float factor = grass_width_factor(lod, share, grass_rank(packed_blade), distance_m, row.max_distance_m);
  // Knots that no step has written yet are not drawn.
  bool fresh = stamps[row.first_place + master_slot] == GLOAM_GRASS_NO_STEP;
  factor = fresh ? 0.0 : factor;
  for (int i = 0; i < 3; ++i) turn[i] = grass_turned(row.turn, turn[i]);
  vec3 moved = row.origin + root - turn * master.root;
  vec3 side = normalize(turn * cross(master.normal, master.forward));
  GrassPose pose;
  pose.carried = row.carried + (root - grass_turned(row.previous_turn, blade.root));
  pose.row0 = vec4(turn[0].x, turn[1].x, turn[2].x, moved.x);
  pose.row1 = vec4(turn[0].y, turn[1].y, turn[2].y, moved.y);
  pose.row2 = vec4(turn[0].z, turn[1].z, turn[2].z, moved.z);
  pose.first_knot = first_knot;
  pose.side = pack_normal(side);
  pose.width = packHalf2x16(vec2(blade.width_m * factor, types[grass_type(packed_blade)].taper));
  // The golden ratio spreads the thresholds of any run of slots evenly; each patch begins elsewhere.
  uint begin = blade_rows[row.first_blade].root_xz * 0x9E3779B1u >> 16;
  uint threshold = (slot * 40503u + begin) & 0xFFFFu;
  pose.layer = grass_color(row, packed_blade) | threshold << 16;
  poses[i] = pose;
  // The same blades cast in every frame, whatever their order. Of a few blades each one's shadow is seen: all cast.
  bool few = row.blades < GLOAM_GRASS_FEW_BLADES;
  if (i < draws.cast_count && (few || threshold * lod.cast_every < 0x10000u)) {
    uint place = atomicAdd(casting.count, 1u);
    casters[place] = i | (few ? GLOAM_GRASS_NOT_WIDER : 0u);
    atomicMax(casting.draw.instances, place / GLOAM_GRASS_DRAW_BLADES + 1u);
    atomicMax(casting.groups.x, place / 64u + 1u);
    if (casting.moved == 0u && (fresh || has_moved(first_knot))) atomicOr(casting.moved, 1u);
  }
}
