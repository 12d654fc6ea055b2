// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_SIMULATION_SOLVER_GLSL
#define GLOAM_SHADERS_GRASS_SIMULATION_SOLVER_GLSL

#include "shaders/grass/blade_api.glsl"
#include "shaders/grass/simulation/wind_api.glsl"

// The formulas of docs/architecture.md, "Grass simulation", for one knot. CPU twin:
// modules/grass/reference/blade_solver.

const vec3 kGravity = vec3(0.0, -9.81, 0.0);
const float kDragAcceleration = 90.0;     // m/s², limit of the wind's acceleration
const float kDragSpeed = 10.0;            // m/s of relative wind that gives a quarter of it
const float kNominalLength = 0.3;         // metres
const float kNominalWidth = 0.006;        // metres
const float kRodBend = 290.0;             // 1/s², at the nominal size, of a blade as thick as it is wide
const float kHeldBend = 260.0;            // 1/s², at the nominal length, of a blade that holds its weight
const float kMostBend = 32400.0;          // 1/s²
const float kLimpDamping = 6.0;           // 1/s, least damping of a blade that nothing holds
const float kDampingRatio = 0.1;          // least damping over the frequency
const float kMostJointCosine = 0.951106;  // of 18 degrees, the greatest angle by which a joint differs from rest
const float kMostJointSine = 0.308866;
const float kModeBend = 160.758;       // 1 over the least eigenvalue of the joints' stiffness
const float kLengthsPerSecond = 30.0;  // bound of a knot's velocity, and of a collider's push
const float kShort = 1e-7;             // metres; a shorter segment has no direction

// Constants of a knot during a dispatch.
struct KnotRest {
  vec3 below;      // unit: direction at rest of the segment below the segment below the knot
  vec3 mirrored;   // direction at rest of the segment below the knot, mirrored at the plane perpendicular to `below`
  float length_m;  // of the segment below the knot
};

// Constants of a blade during a dispatch.
struct BladeRod {
  float joint;     // stiffness of the joint at the root; 1: as inert as a segment
  float gain;      // s²: way of the tip in a step over the external acceleration
  float retained;  // share of its velocity that a knot keeps in a step
  float drag;      // factor on the wind's acceleration: thin blades are light
  float reach_m;   // longest way of a knot in a step
};

// A row of the factors L D Lᵀ of the matrix that holds segments to joints.
struct RodRow {
  float lower;    // L, of the segment below
  float inverse;  // of D
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
KnotRest knot_rest(GrassStem s, vec2 stems[3], uint k) {
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
  return r;
}

// Direction at rest of the segment below the knot.
vec3 rest_direction(KnotRest r) {
  precise vec3 direction = r.mirrored - 2.0 * product(r.below, r.mirrored) * r.below;
  return direction;
}

BladeRod blade_rod(GrassStem s, float type_stiffness, float type_damping, float step_s) {
  precise BladeRod rod;
  precise float stiffness = clamp(type_stiffness, 0.0, 0.999);
  precise float shorter = kNominalLength / max(s.length_m, 1e-4);
  precise float wider = s.width_m / kNominalWidth * shorter * shorter;
  precise float thick = kRodBend * wider * wider;
  precise float held = kHeldBend * shorter;
  precise float bend = min(stiffness / (1.0 - stiffness) * sqrt(thick * thick + held * held), kMostBend);
  precise float in_step = 1.0 + bend * step_s * step_s;
  precise float damping = max(max(type_damping, kLimpDamping - sqrt(bend)), kDampingRatio * sqrt(bend));
  rod.retained = min(exp(-2.0 * damping * step_s) * in_step, 1.0);
  rod.gain = step_s * step_s * in_step;
  rod.joint = kModeBend * bend * rod.gain;
  rod.drag = clamp(kNominalWidth / max(s.width_m, 1e-6), 0.25, 4.0);
  rod.reach_m = kLengthsPerSecond * s.length_m * step_s;
  return rod;
}

// Stiffness of the joint below knot k: a blade is thinner toward its tip. 0 above the tip.
float joint_of(BladeRod rod, int k) {
  precise float joint = rod.joint * (float(max(GLOAM_GRASS_KNOTS - k, 0)) / float(GLOAM_GRASS_KNOTS - 1));
  return joint;
}

// Row k ≥ 1 of the factors, from the row below; that of knot 0 is never used.
RodRow rod_row(BladeRod rod, int k, RodRow below) {
  precise float own = joint_of(rod, k);
  precise float diagonal = 1.0 + own + joint_of(rod, k + 1);
  precise RodRow row;
  row.lower = k >= 2 ? -own * below.inverse : 0.0;
  precise float reduced = diagonal + row.lower * own;
  row.inverse = 1.0 / (k >= 2 ? reduced : diagonal);
  return row;
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

// Verlet: the way of knot k in one step by its velocity, the wind and the external acceleration `pull`. knot_below:
// position of the knot below.
vec3 predicted(BladeRod rod, uint k, vec3 at, vec3 before, vec3 knot_below, vec3 wind, vec3 pull, float step_s) {
  precise vec3 last_way = at - before;
  precise vec3 segment = at - knot_below;
  precise vec3 moved = bounded(last_way, rod.reach_m);
  precise vec3 along = direction_or(segment, vec3(0.0));
  precise vec3 air = wind - moved / step_s;
  air -= along * product(along, air);
  precise float speed = length_of(air);
  precise float eased = speed + kDragSpeed;
  precise vec3 acceleration = pull + air * (rod.drag * kDragAcceleration * speed / (eased * eased));
  precise vec3 way = moved * rod.retained + acceleration * (rod.gain * float(k) / float(GLOAM_GRASS_KNOTS - 1));
  return way;
}

// Unit direction that the joint gives the segment below a knot. below: direction of the segment below that one.
vec3 held_direction(KnotRest r, vec3 below) {
  precise vec3 s = r.below + below;
  precise vec3 target = r.mirrored - s * (2.0 * product(s, r.mirrored) / max(product(s, s), 1e-6));
  return target;
}

// How far the joint below a segment is bent, times its stiffness. segment: as it moves freely; below: as the one below
// it does, and below_now: where that is in this iteration, with the direction along_below; both are 0 at the root.
vec3 joint_strain(KnotRest r, float joint, vec3 segment, vec3 below, vec3 below_now, vec3 along_below) {
  precise vec3 strain = joint * (segment - r.length_m * held_direction(r, along_below) + (below_now - below));
  return strain;
}

// The knot after the one at `from`, which is `height` over the ground plane: at its distance, toward `toward`, but so
// that no joint folds and not below the plane. along: in, the direction of the segment below; out, that of this
// segment.
vec3 restored(vec3 from, inout float height, vec3 toward, KnotRest r, vec3 normal, vec3 forward, inout vec3 along) {
  precise vec3 segment = toward - from;
  float length_m = r.length_m;
  vec3 held = held_direction(r, along);
  precise vec3 d = direction_or(segment, held);
  precise float cosine = product(d, held);
  precise vec3 aside = d - held * cosine;
  precise vec3 limited = held * kMostJointCosine + direction_or(aside, forward) * kMostJointSine;
  d = cosine < kMostJointCosine ? limited : d;
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

// Nearest point of a capsule's axis at a time, as a share of the axis.
float share_of_axis(vec3 at, vec3 from, vec3 to) {
  precise vec3 axis = to - from;
  precise float along = clamp(product(at - from, axis) / max(product(axis, axis), 1e-12), 0.0, 1.0);
  return along;
}

// The way out of a collider at this place.
vec3 way_out(GrassCollider c, vec3 from, vec3 to, vec3 at, vec3 up) {
  precise vec3 axis = to - from;
  precise vec3 at_from = at - from;
  precise vec3 away = at - (from + share_of_axis(at, from, to) * axis);
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
  return push;
}

// When in a step, 0…1, a capsule that moves from (from0, to0) to (from1, to1) is nearest to a knot: the places along
// the axis and in time are found in turn, which is exact for a sphere.
float nearest_time(vec3 at, vec3 from0, vec3 to0, vec3 from1, vec3 to1) {
  precise float time = 1.0;
  [[unroll]] for (int i = 0; i < 4; ++i) {
    precise vec3 from = from0 + (from1 - from0) * time;
    precise vec3 to = to0 + (to1 - to0) * time;
    precise float along = share_of_axis(at, from, to);
    precise vec3 begin = from0 + (to0 - from0) * along;
    precise vec3 way = from1 + (to1 - from1) * along - begin;
    precise float way2 = product(way, way);
    time = way2 > 1e-14 ? clamp(product(at - begin, way) / way2, 0.0, 1.0) : 1.0;
  }
  return time;
}

// The middle of the time, 0…1, in which a box whose centre moves from `begin` to `end` holds a knot; 1 if it never
// does.
float inside_time(GrassCollider c, vec3 at, vec3 begin, vec3 end) {
  precise vec3 to = at - begin, way = end - begin;
  precise float first = 0.0, last = 1.0;
  [[unroll]] for (int i = 0; i < 3; ++i) {
    vec3 axis = i == 0 ? c.axis_x : i == 1 ? c.axis_y : c.axis_z;
    float half_size = i == 0 ? c.half_size.x : i == 1 ? c.half_size.y : c.half_size.z;
    precise float q = product(axis, to), v = product(axis, way);
    bool moves = abs(v) > 1e-7;
    precise float a = (q - half_size) / (moves ? v : 1.0);
    precise float b = (q + half_size) / (moves ? v : 1.0);
    first = max(first, moves ? min(a, b) : (abs(q) <= half_size ? 0.0 : 2.0));
    last = min(last, moves ? max(a, b) : 1.0);
  }
  precise float middle = 0.5 * (first + last);
  return first <= last ? middle : 1.0;
}

// Where a collider pushes a knot in a step: out of the place where it is nearest in the step, then out of where it is
// at the end. begin, end: shares of the frame's steps that have passed.
vec3 pushed(GrassCollider c, vec3 at, vec3 up, float begin, float end, float most) {
  precise vec3 from0 = c.from_previous + (c.from - c.from_previous) * begin;
  precise vec3 from1 = c.from_previous + (c.from - c.from_previous) * end;
  precise vec3 to0 = c.to_previous + (c.to - c.to_previous) * begin;
  precise vec3 to1 = c.to_previous + (c.to - c.to_previous) * end;
  precise float time = nearest_time(at, from0, to0, from1, to1);
  time = c.box != 0u ? inside_time(c, at, from0, from1) : time;
  precise vec3 from = from0 + (from1 - from0) * time;
  precise vec3 to = to0 + (to1 - to0) * time;
  precise vec3 moved = at + bounded(way_out(c, from, to, at, up), most);
  moved = moved + bounded(way_out(c, from1, to1, moved, up), most);
  return moved;
}

#endif
