// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shaders/grass/simulation/masters.glsl"

// Simulates masters (Han and Li, "Grass rendering and simulation with LOD", GPU Pro 6, on the solver of TressFX): one
// thread a knot, 16 threads a blade. Each step moves the knots freely, lets the joints hold them in as many iterations
// as there are, pushes knots out of colliders, and restores lengths and ground from root to tip. The joints of a blade
// are solved at once (projective dynamics: Bouaziz et al. 2014), and not one after the other as in the paper, because
// its local constraints do not let the upper part of a blade bend the lower one. Positions travel between threads in
// shared memory only, so the result does not depend on the width of subgroups or the size of workgroups. Groups: the
// number of masters over the blades of a workgroup, rounded up.

layout(local_size_x = 64, local_size_x_id = 0) in;     // constant 0: 32, 64 or 128
layout(constant_id = 1) const bool kColliders = true;  // false: no patch has colliders

const uint kThreads = gl_WorkGroupSize.x;
const uint kKnots = uint(GLOAM_GRASS_KNOTS);
const uint kBlades = kThreads / kKnots;
const uint kMostThreads = 128u;

// Positions relative to the root. Joints read 0; colliders and the last pass read 0, which writes 1.
shared vec3 knot_at[2][kMostThreads];
shared vec3 free_segment[kMostThreads];  // below each knot, as the knots move freely
shared vec3 direction_of[kMostThreads];  // of the segment below each knot, as joints hold it
shared vec3 strain_of[kMostThreads];
shared vec3 moved_of[kMostThreads];  // force on each segment, then its way by the joints
shared RodRow rows[kMostThreads];
shared BladeRod blade_rods[kMostThreads / kKnots];
shared float segment_m[kMostThreads];  // length of the segment below
shared vec3 rest_below[kMostThreads];
shared vec3 rest_mirrored[kMostThreads];
shared uint turns_of_blade[kMostThreads / kKnots];
shared vec3 blade_normal[kMostThreads / kKnots];
shared vec3 blade_forward[kMostThreads / kKnots];

// The serial passes run on one thread a blade. The others do the same on the first blade's knots up to knot 1, whose
// result they store nowhere.

void factor_rows(uint lane, BladeRod rod) {
  uint knot = min(lane, kBlades - 1u) * kKnots + 1u;
  int k = 1, last = lane < kBlades ? int(kKnots) - 1 : 1;
  RodRow row = RodRow(0.0, 0.0);
  do {
    row = rod_row(rod, k, row);
    if (lane < kBlades) rows[knot] = row;
    ++knot;
  } while (++k <= last);
}

void solve_joints(uint lane) {
  uint first = min(lane, kBlades - 1u) * kKnots;
  uint k = 1u, last = lane < kBlades ? kKnots - 1u : 1u;
  precise vec3 below = vec3(0.0);
  do {
    precise vec3 force = moved_of[first + k];
    force -= rows[first + k].lower * below;
    if (lane < kBlades) moved_of[first + k] = force;
    below = force;
  } while (++k <= last);
  k = kKnots - 1u;
  uint end = lane < kBlades ? 1u : k;
  vec3 above = vec3(0.0);
  float lower = 0.0;
  do {
    RodRow row = rows[first + k];
    precise vec3 way = moved_of[first + k] * row.inverse;
    way -= lower * above;
    if (lane < kBlades) moved_of[first + k] = way;
    above = way;
    lower = row.lower;
    --k;
  } while (k >= end);
}

void place_knots(uint lane) {
  uint knot = min(lane, kBlades - 1u) * kKnots + 1u;
  uint last = lane < kBlades ? knot + kKnots - 2u : knot;
  precise vec3 at = vec3(0.0);
  do {
    at = at + segment_m[knot] * direction_of[knot];
    if (lane < kBlades) knot_at[0][knot] = at;
    ++knot;
  } while (knot <= last);
}

// Where the joints bring the segment below a knot; one iteration.
vec3 held_by_joints(KnotRest r, BladeRod rod, uint lane, uint k, vec3 segment, vec3 direction) {
  bool has_joint = k >= 1u;
  uint below = has_joint ? lane - 1u : lane;
  vec3 along = direction_of[below];
  vec3 below_free = k >= 2u ? free_segment[below] : vec3(0.0);
  vec3 below_now = k >= 2u ? segment_m[below] * along : vec3(0.0);
  vec3 strain = joint_strain(r, joint_of(rod, int(k)), segment, below_free, below_now, along);
  strain_of[lane] = has_joint ? strain : vec3(0.0);
  barrier();
  precise vec3 force = -strain_of[lane];
  if (k + 1u < kKnots) force += strain_of[lane + 1u];
  moved_of[lane] = has_joint ? force : vec3(0.0);
  barrier();
  solve_joints(lane);
  barrier();
  precise vec3 held = segment + moved_of[lane];
  return has_joint ? direction_or(held, direction) : direction;
}

vec3 pushed_by_all(GrassPatchRow patch_row, vec3 root, vec3 normal, vec3 at, float passed, float stride, float most) {
  float begin = max(passed, 0.0) / float(max(steps.frame_steps, 1u));
  float end = max(passed + stride, 0.0) / float(max(steps.frame_steps, 1u));
  precise vec3 in_patch = root + at;
  for (uint i = 0u; i < patch_row.colliders; ++i)
    in_patch = pushed(colliders[patch_row.first_collider + i], in_patch, normal, begin, end, most);
  precise vec3 out_at = in_patch - root;
  return patch_row.colliders != 0u ? out_at : at;
}

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
    from = restored(from, height, knot_at[0][knot], KnotRest(rest_below[knot], rest_mirrored[knot], segment_m[knot]),
                    normal, forward, along);
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
  KnotRest rest = knot_rest(stem, stems, k);
  uint stride = stride_of(master), turns = turns_of(master);
  float step_s = steps.step_s * float(stride);
  BladeRod rod = blade_rod(stem, types[type].stiffness, types[type].damping, step_s);

  uint place = (patch_row.first_place + index) * kKnots + k;
  precise vec3 at = knots[place].xyz - stem.root;
  precise vec3 before = previous_knots[place].xyz - stem.root;
  bool is_finite = dot(at, at) < 1e12 && dot(before, before) < 1e12;  // false for NaN
  if (master.steps == GLOAM_GRASS_NO_STEP || !is_finite) at = before = grass_rest(stem, stems[2]);
  before = scaled_before(at, before, float(stride));
  turns_of_blade[lane / kKnots] = turns;
  if (k == 0u) {
    at = before = vec3(0.0);
    blade_normal[lane / kKnots] = stem.normal;
    blade_forward[lane / kKnots] = stem.forward;
  }
  knot_at[1][lane] = at;
  segment_m[lane] = k == 0u ? 0.0 : rest.length_m;
  rest_below[lane] = rest.below;
  rest_mirrored[lane] = rest.mirrored;
  blade_rods[lane / kKnots] = rod;
  barrier();
  factor_rows(lane, blade_rods[min(lane, kBlades - 1u)]);
  barrier();

  // A blade with fewer steps than the others does the frame's last steps, but in the first turns of the loop. All loops
  // test at their ends: lavapipe runs a loop's body once more for a test at its begin.
  uint most_turns = 1u;
  for (uint i = 0u; i < kBlades; ++i) most_turns = max(most_turns, turns_of_blade[i]);
  uint iterations = max(steps.iterations, 1u);
  precise GrassWind wind = steps.wind;
  precise vec3 wind_at = patch_row.wind_at + grass_turned(patch_row.turn, stem.root);
  vec3 pull = external_acceleration(patch_row);
  uint turn = 0u;
  do {
    float passed = passed_steps(turns - min(turn, turns), stride);
    wind.drift = steps.wind.drift + steps.wind.velocity * (steps.step_s * passed);
    vec3 air = grass_unturned(patch_row.turn, wind_velocity(wind, wind_at));
    precise vec3 next = at + predicted(rod, k, at, before, knot_at[1][k == 0u ? lane : lane - 1u], air, pull, step_s);
    knot_at[0][lane] = k == 0u ? vec3(0.0) : next;
    barrier();
    precise vec3 free = next - knot_at[0][k == 0u ? lane : lane - 1u];
    vec3 direction = k == 0u ? stem.normal : direction_or(free, rest_direction(rest));
    precise vec3 segment = rest.length_m * direction;
    free_segment[lane] = segment;
    uint left = iterations;
    do {
      direction_of[lane] = direction;
      barrier();
      direction = held_by_joints(rest, rod, lane, k, segment, direction);
      --left;
    } while (left != 0u);
    direction_of[lane] = direction;
    barrier();
    place_knots(lane);
    barrier();
    if (kColliders) {
      knot_at[0][lane] =
          pushed_by_all(patch_row, stem.root, stem.normal, knot_at[0][lane], passed, float(stride), rod.reach_m);
      barrier();
    }
    restore_lengths(lane);
    barrier();
    bool runs = turn < turns;
    before = runs ? at : before;
    at = runs && k != 0u ? knot_at[1][lane] : at;
  } while (++turn < most_turns);
  if (!real) return;
  store_knot(place, stem.root, at, scaled_before(at, before, 1.0 / float(stride)), master.steps == GLOAM_GRASS_NO_STEP);
}
