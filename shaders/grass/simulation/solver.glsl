// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_SIMULATION_SOLVER_GLSL
#define GLOAM_SHADERS_GRASS_SIMULATION_SOLVER_GLSL

#include "shaders/grass/blade_api.glsl"
#include "shaders/grass/simulation/wind_api.glsl"

// The formulas of docs/architecture.md, "Grass simulation", for one knot. CPU twin:
// modules/grass/reference/blade_solver.

const float kNominalStep_s = 1.0 / 120.0;
const float kNominalIterations = 3.0;
const vec3 kGravity = vec3(0.0, -9.81, 0.0);
const float kLeastDamping = 2.0;       // 1/s
const float kDragAcceleration = 60.0;  // m/s², limit of the wind's acceleration
const float kDragSpeed = 20.0;         // m/s of relative wind that gives half of it
const float kLengthsPerSecond = 30.0;  // bound of a knot's velocity, and of a collider's push
const float kLowerPart = 0.25;         // of a correction of length; a lower knot counts as three times as heavy
const float kShort = 1e-7;             // metres; a shorter segment has no direction

// Constants of a knot during a dispatch.
struct KnotRest {
  vec3 below;      // unit: direction at rest of the segment below the segment below the knot
  vec3 mirrored;   // direction at rest of the segment below the knot, mirrored at the plane perpendicular to `below`
  float length_m;  // of the segment below the knot
  float gain;      // s²: way of a step over the external acceleration; 0 at the root, largest at the tip
  float share;     // of the local shape that one iteration restores
  float retained;  // share of its velocity that the knot keeps in a step
  float reach_m;   // longest way in a step
};

float product(vec3 a, vec3 b) {
  precise float sum = a.x * b.x + a.y * b.y + a.z * b.z;
  return sum;
}
float length_of(vec3 v) { return sqrt(product(v, v)); }

vec3 direction_or(vec3 v, vec3 otherwise) {
  precise float len = length_of(v);
  precise vec3 direction = v / len;
  return len > kShort ? direction : otherwise;
}

// stems: of the knots two below, one below and at the knot.
KnotRest knot_rest(GrassStem s, vec2 stems[3], float type_stiffness, uint k, float step_s, uint iterations) {
  precise vec3 two_below = grass_rest(s, stems[0]);
  precise vec3 one_below = grass_rest(s, stems[1]);
  precise vec3 at = grass_rest(s, stems[2]);
  precise KnotRest r;
  precise vec3 below = one_below - two_below;
  precise vec3 segment = at - one_below;
  r.below = k >= 2u ? direction_or(below, s.normal) : s.normal;
  precise vec3 direction = direction_or(segment, s.normal);
  r.mirrored = direction - 2.0 * product(r.below, direction) * r.below;
  r.length_m = length_of(segment);
  precise float stiffness = clamp(type_stiffness, 0.0, 0.999);
  precise float nominal = kNominalIterations * stiffness / (1.0 - stiffness);
  precise float ratio = step_s / kNominalStep_s;
  precise float frequency = sqrt(nominal) / kNominalStep_s;
  precise float damped = max(kLeastDamping, 1.41421356 * frequency) * step_s;
  r.retained = exp(-damped);
  precise float gain = (1.0 - r.retained) / damped;
  precise float strength = nominal * ratio * ratio * gain;
  r.share = strength / (float(max(iterations, 1u)) + strength);
  r.gain = gain * step_s * step_s * float(k) / float(GLOAM_GRASS_KNOTS - 1);
  r.reach_m = kLengthsPerSecond * s.length_m * step_s;
  return r;
}

vec3 bounded(vec3 v, float most) {
  precise float len = length_of(v);
  precise vec3 shorter = v * (most / len);
  return len > most ? shorter : v;
}

// Gravity, and the push of an accelerating ground, along the patch's axes.
vec3 external_acceleration(GrassPatchRow patch_row) {
  return grass_unturned(patch_row.turn, kGravity + patch_row.push);
}

// Verlet: the way of a knot in one step by its velocity, the wind and the external acceleration `pull`. knot_below:
// position of the knot below.
vec3 predicted(KnotRest r, vec3 at, vec3 before, vec3 knot_below, vec3 wind, vec3 pull, float step_s) {
  precise vec3 last_way = at - before;
  precise vec3 segment = at - knot_below;
  precise vec3 moved = bounded(last_way, r.reach_m);
  precise vec3 along = direction_or(segment, vec3(0.0));
  precise vec3 air = wind - moved / step_s;
  air -= along * product(along, air);
  precise vec3 acceleration = pull + air * (kDragAcceleration / (length_of(air) + kDragSpeed));
  precise vec3 way = moved * r.retained + acceleration * r.gain;
  return way;
}

// One constraint of the segment between the knots low and high: its length, moving both knots (the root stays), then
// its direction relative to the segment below, moving the upper one. below_low: position of the knot below low; unused
// if low is the root. high_rest: of the knot high.
void constrain(KnotRest high_rest, bool at_root, vec3 below_low, inout vec3 low, inout vec3 high) {
  precise vec3 v = high - low;
  precise float len = length_of(v);
  precise vec3 shift = len > kShort ? v * (1.0 - high_rest.length_m / len) : vec3(0.0);
  precise vec3 new_low = at_root ? low : low + kLowerPart * shift;
  precise vec3 new_high = at_root ? high - shift : high - (1.0 - kLowerPart) * shift;
  precise vec3 segment_below = low - below_low;
  precise vec3 s = high_rest.below + (at_root ? high_rest.below : direction_or(segment_below, high_rest.below));
  precise vec3 target = high_rest.mirrored - s * (2.0 * product(s, high_rest.mirrored) / max(product(s, s), 1e-6));
  precise vec3 shaped = new_high + high_rest.share * (new_low + high_rest.length_m * target - new_high);
  low = new_low;
  high = shaped;
}

// The knot after the one at `from`, which is `height` over the ground plane: at the distance length_m, toward `toward`
// but not below the plane. along: in, the direction of the segment below; out, that of this segment.
vec3 restored(vec3 from, inout float height, vec3 toward, float length_m, vec3 normal, vec3 forward, inout vec3 along) {
  precise vec3 segment = toward - from;
  precise vec3 d = direction_or(segment, along);
  precise float climb = product(d, normal);
  precise float level2 = 1.0 - climb * climb;  // squared length of the part of d in the plane
  precise float least = length_m > 0.0 ? max(-height / length_m, -1.0) : -1.0;
  if (climb < least) {
    precise float levelled = sqrt(max(1.0 - least * least, 0.0));
    precise vec3 level = d - normal * climb;
    d = (level2 > 1e-6 ? level * (levelled / sqrt(level2)) : forward * levelled) + normal * least;
    climb = least;
  }
  along = d;
  precise float next_height = height + length_m * climb;
  height = max(next_height, 0.0);
  precise vec3 knot = from + length_m * d;
  return knot;
}

// Where a collider pushes a knot. passed: share of the frame's steps that has passed at the end of this step.
vec3 pushed(GrassCollider c, vec3 at, vec3 up, float passed, float most) {
  precise vec3 from = c.from_previous + (c.from - c.from_previous) * passed;
  precise vec3 to = c.to_previous + (c.to - c.to_previous) * passed;
  precise vec3 axis = to - from;
  precise vec3 at_from = at - from;
  precise float along = clamp(product(at_from, axis) / max(product(axis, axis), 1e-12), 0.0, 1.0);
  precise vec3 away = at - (from + along * axis);
  precise float depth = c.radius_m - length_of(away);
  precise vec3 push = depth > 0.0 ? direction_or(away, up) * depth : vec3(0.0);
  if (c.box != 0u) {
    precise vec3 q = vec3(product(c.axis_x, at_from), product(c.axis_y, at_from), product(c.axis_z, at_from));
    precise vec3 inside = c.half_size - abs(q);
    precise float least = min(inside.x, min(inside.y, inside.z));
    precise vec3 out_axis = inside.x <= least   ? c.axis_x * (q.x < 0.0 ? -1.0 : 1.0)
                            : inside.y <= least ? c.axis_y * (q.y < 0.0 ? -1.0 : 1.0)
                                                : c.axis_z * (q.z < 0.0 ? -1.0 : 1.0);
    push = least > 0.0 ? out_axis * least : vec3(0.0);
  }
  precise vec3 moved = at + bounded(push, most);
  return moved;
}

#endif
