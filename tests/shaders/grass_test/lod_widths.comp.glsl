// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/lod/lod_api.glsl"

// Share of the blades that are kept, and factor of the width, of one blade per thread.
layout(local_size_x = 64) in;

struct TestBlade {
  float width_m;
  float rank;
  float distance_m;
  float max_distance_m;
};
layout(set = 0, binding = 0, scalar) uniform Lod { GrassLod lod; };
layout(set = 0, binding = 1, scalar) readonly buffer Blades { TestBlade blades[]; };
layout(set = 0, binding = 2, scalar) writeonly buffer Results { vec2 results[]; };

void main() {
  TestBlade b = blades[gl_GlobalInvocationID.x];
  float share = grass_share(lod, b.width_m, b.distance_m);
  results[gl_GlobalInvocationID.x] =
      vec2(share, grass_width_factor(lod, share, b.rank, b.distance_m, b.max_distance_m));
}
