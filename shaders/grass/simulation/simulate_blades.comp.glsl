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
vec3 at[kKnots], before[kKnots], next[kKnots], way[kKnots];
KnotRest rest[kKnots];

// The segments from knot `first` on, every other one. From tip to root: a segment reads the knot below it as it was.
void half_iteration(int first) {
  [[unroll]] for (int low = kKnots - 2; low >= 0; --low) {
    if ((low & 1) != first) continue;
    vec3 below_low = low >= 1 ? next[max(low, 1) - 1] : vec3(0.0);
    constrain(rest[low + 1], low == 0, below_low, next[low], next[low + 1]);
  }
}

void push_out(GrassPatchRow patch_row, GrassStem stem, uint step) {
  float passed = float(step + 1u) / float(max(steps.frame_steps, 1u));
  if (patch_row.colliders == 0u) return;
  [[unroll]] for (int k = 0; k < kKnots; ++k) {
    precise vec3 knot = stem.root + next[k];
    uint i = 0u;
    do {  // inside the loop over knots: see docs/experiments.md, "Shadow filters on SwiftShader"
      knot = pushed(colliders[patch_row.first_collider + i], knot, stem.normal, passed, rest[k].reach_m);
    } while (++i < patch_row.colliders);
    precise vec3 out_at = knot - stem.root;
    next[k] = out_at;
  }
}

void load_knots(GrassPatchRow patch_row, GrassStem stem, uint type, uint place, bool fresh) {
  [[unroll]] for (int k = 0; k < kKnots; ++k) {
    vec2 stems[3] = {types[type].stem[max(k, 2) - 2], types[type].stem[max(k, 1) - 1], types[type].stem[k]};
    rest[k] = knot_rest(stem, stems, types[type].stiffness, uint(k), steps.step_s, steps.iterations);
    precise vec3 knot = knots[place + uint(k)].xyz - stem.root;
    precise vec3 previous = previous_knots[place + uint(k)].xyz - stem.root;
    bool is_valid = !fresh && dot(knot, knot) < 1e12 && dot(previous, previous) < 1e12;  // false for NaN
    vec3 still = grass_rest(stem, stems[2]);
    at[k] = is_valid ? knot : still;
    before[k] = is_valid ? previous : still;
  }
  at[0] = before[0] = vec3(0.0);
}

// One step: see simulate.comp.
void advance(GrassPatchRow patch_row, GrassStem stem, uint step, bool runs) {
  uint iterations = max(steps.iterations, 1u);
  precise GrassWind wind = steps.wind;
  precise vec3 wind_at = patch_row.wind_at + grass_turned(patch_row.turn, stem.root);
  vec3 pull = external_acceleration(patch_row);
  wind.drift = steps.wind.drift + steps.wind.velocity * (steps.step_s * float(step));
  vec3 air = grass_unturned(patch_row.turn, wind_velocity(wind, wind_at));
  [[unroll]] for (int k = 0; k < kKnots; ++k) {
    precise vec3 moved = predicted(rest[k], at[k], before[k], at[max(k, 1) - 1], air, pull, steps.step_s);
    moved /= float(iterations);
    way[k] = moved;
    next[k] = at[k];
  }
  uint left = iterations;
  do {
    [[unroll]] for (int k = 0; k < kKnots; ++k) {
      precise vec3 sum = next[k] + way[k];
      next[k] = sum;
    }
    half_iteration(0);
    half_iteration(1);
    --left;
  } while (left != 0u);
  if (kColliders) push_out(patch_row, stem, step);
  vec3 from = vec3(0.0), along = stem.normal;
  float height = 0.0;
  [[unroll]] for (int k = 1; k < kKnots; ++k) {
    from = restored(from, height, next[k], rest[k].length_m, stem.normal, stem.forward, along);
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
  load_knots(patch_row, stem, grass_type(row), place, master.steps == GLOAM_GRASS_NO_STEP);

  uint own_steps = min(master.steps, steps.frame_steps), turn = 0u;
  do {
    advance(patch_row, stem, turn + steps.frame_steps - own_steps, turn < own_steps);
  } while (++turn < steps.frame_steps);

  bool fresh = master.steps == GLOAM_GRASS_NO_STEP;
  [[unroll]] for (int k = 0; k < kKnots; ++k) store_knot(place + uint(k), stem.root, at[k], before[k], fresh);
}
