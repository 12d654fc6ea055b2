// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/grass/simulation/masters.glsl"

// The simulation of simulate.comp with one thread a blade, for devices that run the threads of a workgroup in turn:
// there a barrier swaps the state of all threads, and shared memory is read lane by lane. All loops over knots are
// unrolled, so knots stay in registers. Formulas, bindings and order are the same. Groups: masters over 32, rounded up.

layout(local_size_x = 64) in;
layout(constant_id = 1) const bool kColliders = true;  // false: no patch has colliders

const int kKnots = GLOAM_GRASS_KNOTS;

// Positions relative to the root. Knot 0 is the root and stays at 0.
vec3 at[kKnots], before[kKnots], next[kKnots];
KnotRest rest[kKnots];
BladeRod rod;
RodRow rows[kKnots];
vec3 segment[kKnots];    // below each knot, as the knots move freely
vec3 direction[kKnots];  // of the segment below each knot, as joints hold it
vec3 strain[kKnots];     // then the way by which the joints move the segment

void bend_joints() {
  [[unroll]] for (int k = 1; k < kKnots; ++k) {
    vec3 below = segment[k - 1], along = direction[k - 1];
    strain[k] = joint_strain(rest[k], joint_of(rod, k), segment[k], below, rest[k - 1].length_m * along, along);
  }
  [[unroll]] for (int k = 1; k < kKnots; ++k) {
    precise vec3 force = -strain[k];
    if (k + 1 < kKnots) force += strain[min(k + 1, kKnots - 1)];
    if (k >= 2) force -= rows[k].lower * strain[k - 1];
    strain[k] = force;
  }
  [[unroll]] for (int k = kKnots - 1; k > 0; --k) {
    precise vec3 way = strain[k] * rows[k].inverse;
    if (k + 1 < kKnots) way -= rows[min(k + 1, kKnots - 1)].lower * strain[min(k + 1, kKnots - 1)];
    strain[k] = way;
    precise vec3 held = segment[k] + way;
    direction[k] = direction_or(held, direction[k]);
  }
}

void push_out(GrassPatchRow patch_row, GrassStem stem, float passed, float stride) {
  float begin = max(passed, 0.0) / float(max(steps.frame_steps, 1u));
  float end = max(passed + stride, 0.0) / float(max(steps.frame_steps, 1u));
  if (patch_row.colliders == 0u) return;
  [[unroll]] for (int k = 1; k < kKnots; ++k) {
    precise vec3 knot = stem.root + next[k];
    uint i = 0u;
    do {  // inside the loop over knots: see docs/experiments.md, "Shadow filters on SwiftShader"
      knot = pushed(colliders[patch_row.first_collider + i], knot, stem.normal, begin, end, rod.reach_m);
    } while (++i < patch_row.colliders);
    precise vec3 out_at = knot - stem.root;
    next[k] = out_at;
  }
}

void load_knots(GrassPatchRow patch_row, GrassStem stem, uint type, uint place, bool fresh, float stride) {
  [[unroll]] for (int k = 0; k < kKnots; ++k) {
    vec2 stems[3] = {types[type].stem[max(k, 2) - 2], types[type].stem[max(k, 1) - 1], types[type].stem[k]};
    rest[k] = knot_rest(stem, stems, uint(k));
    precise vec3 knot = knots[place + uint(k)].xyz - stem.root;
    precise vec3 previous = previous_knots[place + uint(k)].xyz - stem.root;
    bool is_valid = !fresh && dot(knot, knot) < 1e12 && dot(previous, previous) < 1e12;  // false for NaN
    vec3 still = grass_rest(stem, stems[2]);
    at[k] = is_valid ? knot : still;
    before[k] = is_valid ? scaled_before(knot, previous, stride) : still;
  }
  at[0] = before[0] = next[0] = segment[0] = vec3(0.0);
  direction[0] = stem.normal;
  rest[0].length_m = 0.0;
  rod = blade_rod(stem, types[type].stiffness, types[type].damping, steps.step_s * stride);
  rows[0] = RodRow(0.0, 0.0);
  [[unroll]] for (int k = 1; k < kKnots; ++k) rows[k] = rod_row(rod, k, rows[k - 1]);
}

// One step: see simulate.comp. passed: of the frame, in its steps.
void advance(GrassPatchRow patch_row, GrassStem stem, float passed, float stride, bool runs) {
  float step_s = steps.step_s * stride;
  uint iterations = max(steps.iterations, 1u);
  precise GrassWind wind = steps.wind;
  precise vec3 wind_at = patch_row.wind_at + grass_turned(patch_row.turn, stem.root);
  vec3 pull = external_acceleration(patch_row);
  wind.drift = steps.wind.drift + steps.wind.velocity * (steps.step_s * passed);
  vec3 air = grass_unturned(patch_row.turn, wind_velocity(wind, wind_at));
  [[unroll]] for (int k = 1; k < kKnots; ++k) {
    precise vec3 free = at[k] + predicted(rod, uint(k), at[k], before[k], at[k - 1], air, pull, step_s);
    precise vec3 along = free - next[k - 1];
    next[k] = free;
    direction[k] = direction_or(along, rest_direction(rest[k]));
    precise vec3 kept = rest[k].length_m * direction[k];
    segment[k] = kept;
  }
  uint left = iterations;
  do {
    bend_joints();
    --left;
  } while (left != 0u);
  [[unroll]] for (int k = 1; k < kKnots; ++k) {
    precise vec3 held = next[k - 1] + rest[k].length_m * direction[k];
    next[k] = held;
  }
  if (kColliders) push_out(patch_row, stem, passed, stride);
  vec3 from = vec3(0.0), along = stem.normal;
  float height = 0.0;
  [[unroll]] for (int k = 1; k < kKnots; ++k) {
    from = restored(from, height, next[k], rest[k], stem.normal, stem.forward, along);
    before[k] = runs ? at[k] : before[k];
    at[k] = runs ? from : at[k];
  }
}

void main() {
  uint entry = gl_GlobalInvocationID.x;
  if (entry >= master_count) return;
  GrassMaster master = master_list[entry];
  GrassPatchRow patch_row = patches[master.blade >> 8];
  uint index = master.blade & 0xFFu;
  GrassBladeRow row = blade_rows[patch_row.first_blade + index];
  GrassStem stem = grass_stem(patch_row, row);
  uint place = (patch_row.first_place + index) * uint(kKnots);
  bool fresh = master.steps == GLOAM_GRASS_NO_STEP;
  uint stride = stride_of(master), turns = turns_of(master), turn = 0u;
  load_knots(patch_row, stem, grass_type(row), place, fresh, float(stride));
  do {
    advance(patch_row, stem, passed_steps(turns - min(turn, turns), stride), float(stride), turn < turns);
  } while (++turn < turns);
  [[unroll]] for (int k = 0; k < kKnots; ++k)
      store_knot(place + uint(k), stem.root, at[k], scaled_before(at[k], before[k], 1.0 / float(stride)), fresh);
}
