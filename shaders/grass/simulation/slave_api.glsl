// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_SIMULATION_SLAVE_API_GLSL
#define GLOAM_SHADERS_GRASS_SIMULATION_SLAVE_API_GLSL

#include "shaders/grass/blade_api.glsl"

// Knots of a slave from those of its master: a rotation and a scale, so that lengths and the order of heights hold.
// 1. The least rotation from the master's ground normal to the slave's. A knot keeps its height over the ground.
// 2. A turn about the slave's ground normal: the difference of their yaws, which fades out as the master bends, because
//    wind bends all blades in its own direction; plus a share of it and of the slave's hash that grows with the speed
//    of the master's tip. The turn moves a knot in proportion to its distance from the normal, so it grows toward the
//    tip.
// 3. The ratio of their lengths.
// CPU twin: modules/grass/reference/slave_pose.

const float kSlaveTurn = 0.3;       // radians, largest turn by speed
const float kSlaveTurnSpeed = 1.5;  // m/s at which it is half as large
const float kSlaveFadedBend = 0.6;  // way of the tip, over the length, at which the difference of yaws has no effect

// A value in [-1, 1] of a slave. slot: of the slave in its patch.
float slave_hash(uint slot) {
  uint h = (slot + 1u) * 0x9E3779B1u;
  h = (h ^ h >> 15) * 0x85EBCA77u;
  return float((h ^ h >> 13) & 0xFFFFu) * (2.0 / 65535.0) - 1.0;
}

// Least rotation of `v` that takes unit vector a to unit vector b.
vec3 slave_tilt(vec3 a, vec3 b, vec3 v) {
  vec3 s = a + b;
  vec3 mirrored = v - 2.0 * dot(a, v) * a;
  return mirrored - s * (2.0 * dot(s, mirrored) / max(dot(s, s), 1e-6));
}

// The rotation and scale of all knots of a slave. slot: index of the slave in its patch. master_tip, rest_tip: the
// master's last knot, now and at rest, relative to its root; tip_speed: m/s.
mat3 slave_turn(GrassStem master, GrassStem slave, uint slot, vec3 master_tip, vec3 rest_tip, float tip_speed) {
  float length_m = max(master.length_m, 1e-6);
  float bend = min(length(master_tip - rest_tip) / (kSlaveFadedBend * length_m), 1.0);
  float faded = 1.0 - bend * bend * (3.0 - 2.0 * bend);
  float yaw = slave.yaw - master.yaw;
  yaw -= 2.0 * kPi * floor(yaw / (2.0 * kPi) + 0.5);
  float angle = yaw * faded + kSlaveTurn * slave_hash(slot) * tip_speed / (tip_speed + kSlaveTurnSpeed);
  vec2 circle = unit_circle(angle / (2.0 * kPi));
  float c = circle.x, s = circle.y;
  mat3 turn;
  for (int i = 0; i < 3; ++i) {
    vec3 axis = vec3(i == 0 ? 1.0 : 0.0, i == 1 ? 1.0 : 0.0, i == 2 ? 1.0 : 0.0);
    vec3 v = slave_tilt(master.normal, slave.normal, axis);
    v = c * v + s * cross(slave.normal, v) + slave.normal * (dot(slave.normal, v) * (1.0 - c));
    turn[i] = v * (slave.length_m / length_m);
  }
  return turn;
}

// Knot of a slave, relative to its root. master_knot: the same knot of the master, relative to the master's root.
vec3 slave_knot(mat3 turn, vec3 master_knot) { return turn * master_knot; }

#endif
