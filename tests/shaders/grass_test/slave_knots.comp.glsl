// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/simulation/slave_api.glsl"

// All knots of one slave per thread, relative to its root.
layout(local_size_x = 64) in;

struct TestSlave {
  vec3 master_normal;
  float master_yaw;
  float master_length_m;
  vec3 slave_normal;
  float slave_yaw;
  float slave_length_m;
  uint slot;
  vec3 rest_tip;
  float tip_speed;
  vec3 master_knots[GLOAM_GRASS_KNOTS];
};
layout(set = 0, binding = 0, scalar) readonly buffer Slaves { TestSlave slaves[]; };
layout(set = 0, binding = 1, scalar) writeonly buffer Knots { vec4 slave_knots[]; };

GrassStem stem_of(vec3 normal, float yaw, float length_m) {
  return GrassStem(vec3(0.0), normal, grass_forward(normal, yaw), yaw, length_m, 0.01);
}

void main() {
  uint i = gl_GlobalInvocationID.x;
  TestSlave s = slaves[i];
  GrassStem master = stem_of(s.master_normal, s.master_yaw, s.master_length_m);
  GrassStem slave = stem_of(s.slave_normal, s.slave_yaw, s.slave_length_m);
  mat3 turn = slave_turn(master, slave, s.slot, slaves[i].master_knots[GLOAM_GRASS_KNOTS - 1], s.rest_tip, s.tip_speed);
  for (uint k = 0u; k < uint(GLOAM_GRASS_KNOTS); ++k)
    slave_knots[i * uint(GLOAM_GRASS_KNOTS) + k] = vec4(slave_knot(turn, slaves[i].master_knots[k]), 0.0);
}
