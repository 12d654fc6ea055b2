// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/particles/particles_shared.h"

// Turns the histogram of the last pass of the sort into the arguments of the passes that follow. One thread.

layout(local_size_x = 1) in;

layout(set = 0, binding = 0, scalar) readonly buffer Bins { uint bins[257]; };  // exclusive prefix sum
layout(set = 0, binding = 1, scalar) writeonly buffer Draws { ParticleDraws draws; };

void main() {
  uint drawn = bins[255];  // particles that are not drawn have the greatest digit
  uint groups = (drawn + 63u) / 64u;
  // More than 65535 workgroups take two dimensions.
  uint rows = (groups + 32767u) / 32768u;
  draws.indices = 6u * GLOAM_PARTICLE_DRAW_SPRITES;
  draws.instances = (drawn + GLOAM_PARTICLE_DRAW_SPRITES - 1u) / GLOAM_PARTICLE_DRAW_SPRITES;
  draws.first_index = 0u;
  draws.vertex_offset = 0u;
  draws.first_instance = 0u;
  draws.drawn = drawn;
  draws.light_groups = uvec3(min(groups, 32768u), rows, 1u);
}
