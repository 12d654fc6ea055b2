// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/simulation/masters.glsl"

// Simulates masters (Han and Li, "Grass rendering and simulation with LOD", GPU Pro 6, on the solver of TressFX): one
// thread a knot, 16 threads a blade. Each step moves the knots in as many parts as there are iterations, runs the
// constraints on the even and the odd segments after each part, pushes knots out of colliders, and restores lengths and
// ground from root to tip. Positions travel between threads in shared memory only, so the result does not depend on the
// width of subgroups or the size of workgroups. Groups: the number of masters over the blades of a workgroup, rounded
// up.

layout(local_size_x = 64, local_size_x_id = 0) in;     // constant 0: 32, 64 or 128
layout(constant_id = 1) const bool kColliders = true;  // false: no patch has colliders

const uint kThreads = gl_WorkGroupSize.x;
const uint kKnots = uint(GLOAM_GRASS_KNOTS);
const uint kBlades = kThreads / kKnots;
const uint kMostThreads = 128u;

// Positions relative to the root. A step reads 1 and writes 0; each stage of the constraints reads one and writes the
// other; the last pass reads 0 and writes 1.
shared vec3 knot_at[2][kMostThreads];
shared float segment_m[kMostThreads];  // length of the segment below
shared vec3 blade_normal[kMostThreads / kKnots];
shared vec3 blade_forward[kMostThreads / kKnots];

// The knot after one stage. odd: of the segments that begin at even knots (0) or odd knots (1).
vec3 stage(KnotRest r, uint lane, uint k, vec3 at, uint odd) {
  bool upper = (k & 1u) != odd;
  bool pairs = upper ? k != 0u : k + 1u < kKnots;
  vec3 other = pairs ? knot_at[odd][upper ? lane - 1u : lane + 1u] : at;
  vec3 below_low = upper && k >= 2u ? knot_at[odd][lane - 2u] : vec3(0.0);
  KnotRest high_rest = r;
  high_rest.length_m = upper || !pairs ? r.length_m : segment_m[lane + 1u];
  vec3 low = upper ? other : at, high = upper ? at : other;
  constrain(high_rest, k == (upper ? 1u : 0u), below_low, low, high);
  return !pairs ? at : upper ? high : low;
}

vec3 pushed_by_all(GrassPatchRow patch_row, vec3 root, vec3 normal, vec3 at, uint step, float most) {
  float passed = float(step + 1u) / float(max(steps.frame_steps, 1u));
  precise vec3 in_patch = root + at;
  for (uint i = 0u; i < patch_row.colliders; ++i)
    in_patch = pushed(colliders[patch_row.first_collider + i], in_patch, normal, passed, most);
  precise vec3 out_at = in_patch - root;
  return patch_row.colliders != 0u ? out_at : at;
}

// One thread a blade; the others leave the loop after one turn, whose result they store nowhere.
void restore_lengths(uint lane) {
  uint blade = min(lane, kBlades - 1u);
  vec3 normal = blade_normal[blade];
  vec3 forward = blade_forward[blade];
  vec3 from = vec3(0.0);
  vec3 along = normal;
  float height = 0.0;
  uint knot = blade * kKnots + 1u;
  uint last = lane < kBlades ? knot + kKnots - 2u : knot;
  do {
    from = restored(from, height, knot_at[0][knot], segment_m[knot], normal, forward, along);
    if (lane < kBlades) knot_at[1][knot] = from;
    ++knot;
  } while (knot <= last);
}

void main() {
  uint lane = gl_LocalInvocationIndex;
  uint k = lane % kKnots;
  uint entry = gl_WorkGroupID.x * kBlades + lane / kKnots;
  if (gl_WorkGroupID.x * kBlades >= master_count) return;  // uniform over the workgroup
  bool real = entry < master_count;
  GrassMaster master = master_list[min(entry, master_count - 1u)];
  GrassPatchRow patch_row = patches[master.blade >> 8];
  uint index = master.blade & 0xFFu;
  GrassBladeRow row = blade_rows[patch_row.first_blade + index];
  GrassStem stem = grass_stem(patch_row, row);
  uint type = grass_type(row);
  vec2 stems[3] = {types[type].stem[max(k, 2u) - 2u], types[type].stem[max(k, 1u) - 1u], types[type].stem[k]};
  KnotRest rest = knot_rest(stem, stems, types[type].stiffness, k, steps.step_s, steps.iterations);

  uint place = (patch_row.first_place + index) * kKnots + k;
  precise vec3 at = knots[place].xyz - stem.root;
  precise vec3 before = previous_knots[place].xyz - stem.root;
  bool is_finite = dot(at, at) < 1e12 && dot(before, before) < 1e12;  // false for NaN
  if (master.steps == GLOAM_GRASS_NO_STEP || !is_finite) at = before = grass_rest(stem, stems[2]);
  if (k == 0u) {
    at = before = vec3(0.0);
    blade_normal[lane / kKnots] = stem.normal;
    blade_forward[lane / kKnots] = stem.forward;
  }
  knot_at[1][lane] = at;
  segment_m[lane] = rest.length_m;
  barrier();

  // A blade with fewer steps than the frame does the frame's last steps, but in the first turns of the loop. All loops
  // test at their ends: lavapipe runs a loop's body once more for a test at its begin.
  uint own_steps = min(master.steps, steps.frame_steps);
  uint iterations = max(steps.iterations, 1u);
  precise GrassWind wind = steps.wind;
  precise vec3 wind_at = patch_row.wind_at + grass_turned(patch_row.turn, stem.root);
  vec3 pull = external_acceleration(patch_row);
  uint turn = 0u;
  do {
    uint step = turn + steps.frame_steps - own_steps;
    wind.drift = steps.wind.drift + steps.wind.velocity * (steps.step_s * float(step));
    vec3 air = grass_unturned(patch_row.turn, wind_velocity(wind, wind_at));
    precise vec3 way = predicted(rest, at, before, knot_at[1][k == 0u ? lane : lane - 1u], air, pull, steps.step_s);
    way /= float(iterations);
    precise vec3 next = at + way;
    knot_at[0][lane] = next;
    uint odd = 0u;
    uint left = 2u * iterations;
    do {
      barrier();
      next = stage(rest, lane, k, next, odd);
      odd ^= 1u;
      --left;
      if (odd == 0u && left != 0u) next += way;
      knot_at[odd][lane] = next;
    } while (left != 0u);
    if (kColliders) knot_at[0][lane] = pushed_by_all(patch_row, stem.root, stem.normal, next, step, rest.reach_m);
    barrier();
    restore_lengths(lane);
    barrier();
    bool runs = turn < own_steps;
    before = runs ? at : before;
    at = runs && k != 0u ? knot_at[1][lane] : at;
  } while (++turn < steps.frame_steps);
  if (!real) return;
  store_knot(place, stem.root, at, before, master.steps == GLOAM_GRASS_NO_STEP);
}
