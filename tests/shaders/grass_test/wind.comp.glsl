// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/simulation/wind_api.glsl"

// The wind's velocity at each point.
layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) uniform WindBlock { GrassWind wind; };
layout(set = 0, binding = 1, scalar) readonly buffer Points { vec4 points[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Velocities { vec4 velocities[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  velocities[i] = vec4(wind_velocity(wind, points[i].xyz), 0.0);
}
