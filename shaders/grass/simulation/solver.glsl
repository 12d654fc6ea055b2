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

// What stays the same for a knot during a dispatch.
struct KnotRest {
  vec3 below;      // unit: direction at rest of the segment below the segment below the knot
  vec3 mirrored;   // direction at rest of the segment below the knot, mirrored at the plane perpendicular to `below`
  float length_m;  // of the segment below the knot
  float above_m;   // length of the segment above
  float gain;      // s²: way of a step over the external acceleration; 0 at the root, largest at the tip
  float share;     // of the local shape that one iteration restores
  float retained;  // share of its velocity that the knot keeps in a step
  float reach_m;   // longest way in a step
};

vec3 direction_or(vec3 v, vec3 otherwise) {
  float len = length(v);
  return len > kShort ? v / len : otherwise;
}

// stems: of the knots two below, one below, at and above the knot.
KnotRest knot_rest(GrassStem s, vec2 stems[4], float type_stiffness, uint k, float step_s, uint iterations) {
  vec3 two_below = grass_rest(s, stems[0]);
  vec3 one_below = grass_rest(s, stems[1]);
  vec3 at = grass_rest(s, stems[2]);
  vec3 above = grass_rest(s, stems[3]);
  KnotRest r;
  r.below = k >= 2u ? direction_or(one_below - two_below, s.normal) : s.normal;
  vec3 direction = direction_or(at - one_below, s.normal);
  r.mirrored = direction - 2.0 * dot(r.below, direction) * r.below;
  r.length_m = length(at - one_below);
  r.above_m = length(above - at);
  float stiffness = clamp(type_stiffness, 0.0, 0.999);
  float nominal = pow(1.0 - stiffness, -kNominalIterations) - 1.0;
  float ratio = step_s / kNominalStep_s;
  float frequency = sqrt(nominal) / kNominalStep_s;
  float damped = max(kLeastDamping, 1.41421356 * frequency) * step_s;
  r.retained = exp(-damped);
  float gain = (1.0 - r.retained) / damped;
  r.share = 1.0 - pow(1.0 + nominal * ratio * ratio * gain, -1.0 / float(max(iterations, 1u)));
  r.gain = gain * step_s * step_s * float(k) / float(GLOAM_GRASS_KNOTS - 1);
  r.reach_m = kLengthsPerSecond * s.length_m * step_s;
  return r;
}

vec3 bounded(vec3 v, float most) {
  float len = length(v);
  return len > most ? v * (most / len) : v;
}

// Verlet: the knot's next position. knot_below: position of the knot below.
vec3 predicted(KnotRest r, vec3 at, vec3 before, vec3 knot_below, vec3 wind, float step_s) {
  vec3 moved = bounded(at - before, r.reach_m);
  vec3 along = direction_or(at - knot_below, vec3(0.0));
  vec3 air = wind - moved / step_s;
  air -= along * dot(along, air);
  vec3 acceleration = kGravity + air * (kDragAcceleration / (length(air) + kDragSpeed));
  return at + moved * r.retained + acceleration * r.gain;
}

// One constraint of the segment between the knots low and high: its length, moving both knots (the root stays), then
// its direction relative to the segment below, moving the upper one. Returns the new position of high, or that of low.
// below_low: position of the knot below low; unused if low is the root. r: of the knot that is returned.
vec3 constrained(KnotRest r, bool upper, bool at_root, vec3 below_low, vec3 low, vec3 high) {
  precise vec3 v = high - low;
  float len = length(v);
  float wanted = upper ? r.length_m : r.above_m;
  precise vec3 shift = len > kShort ? v * (1.0 - wanted / len) : vec3(0.0);
  precise vec3 new_low = at_root ? low : low + kLowerPart * shift;
  precise vec3 new_high = at_root ? high - shift : high - (1.0 - kLowerPart) * shift;
  vec3 s = r.below + (at_root ? r.below : direction_or(low - below_low, r.below));
  vec3 target = r.mirrored - s * (2.0 * dot(s, r.mirrored) / max(dot(s, s), 1e-6));
  precise vec3 shaped = new_high + r.share * (new_low + wanted * target - new_high);
  return upper ? shaped : new_low;
}

// The knot after the one at `from`, which is `height` over the ground plane: at the distance length_m, toward `toward`
// but not below the plane. along: in, the direction of the segment below; out, that of this segment.
vec3 restored(vec3 from, inout float height, vec3 toward, float length_m, vec3 normal, vec3 forward, inout vec3 along) {
  vec3 d = direction_or(toward - from, along);
  float climb = dot(d, normal);
  float level2 = 1.0 - climb * climb;  // squared length of the part of d in the plane
  float least = length_m > 0.0 ? max(-height / length_m, -1.0) : -1.0;
  if (climb < least) {
    float levelled = sqrt(max(1.0 - least * least, 0.0));
    vec3 level = d - normal * climb;
    d = (level2 > 1e-6 ? level * (levelled / sqrt(level2)) : forward * levelled) + normal * least;
    climb = least;
  }
  along = d;
  height = max(height + length_m * climb, 0.0);
  return from + length_m * d;
}

// Where a collider pushes a knot. passed: share of the frame's steps that has passed at the end of this step.
vec3 pushed(GrassCollider c, vec3 at, vec3 up, float passed, float most) {
  vec3 from = mix(c.from_previous, c.from, passed);
  vec3 to = mix(c.to_previous, c.to, passed);
  vec3 axis = to - from;
  float along = clamp(dot(at - from, axis) / max(dot(axis, axis), 1e-12), 0.0, 1.0);
  vec3 away = at - (from + along * axis);
  float depth = c.radius_m - length(away);
  vec3 push = depth > 0.0 ? direction_or(away, up) * depth : vec3(0.0);
  if (c.box != 0u) {
    vec3 q = vec3(dot(c.axis_x, at - from), dot(c.axis_y, at - from), dot(c.axis_z, at - from));
    vec3 inside = c.half_size - abs(q);
    float least = min(inside.x, min(inside.y, inside.z));
    vec3 out_axis = inside.x <= least   ? c.axis_x * (q.x < 0.0 ? -1.0 : 1.0)
                    : inside.y <= least ? c.axis_y * (q.y < 0.0 ? -1.0 : 1.0)
                                        : c.axis_z * (q.z < 0.0 ? -1.0 : 1.0);
    push = least > 0.0 ? out_axis * least : vec3(0.0);
  }
  return at + bounded(push, most);
}

#endif
