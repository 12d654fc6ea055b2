// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/blade_api.glsl"
#include "shaders/grass/lod/lod_api.glsl"

// Sort keys of the blades of the view's patches: distance in 255 steps, or GLOAM_GRASS_CULLED. One workgroup per patch,
// four blades per thread.

layout(local_size_x = 64) in;

layout(set = 0, binding = 0, scalar) uniform Lod { GrassLod lod; };
layout(set = 0, binding = 1, scalar) readonly buffer Patches { GrassPatchRow patches[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Rows { GrassBladeRow blade_rows[]; };
layout(set = 0, binding = 3, scalar) writeonly buffer Keys { uint keys[]; };

// Every knot of a blade lies within its length of the root.
bool in_view(vec3 root, float length_m) {
  bool inside = true;
  for (int i = 0; i < 5; ++i) inside = inside && dot(lod.planes[i].xyz, root) + lod.planes[i].w >= -length_m;
  return inside;
}

uint key_of(GrassPatchRow row, uint index) {
  GrassBladeRow packed_blade = blade_rows[row.first_blade + min(index, row.blades - 1u)];
  GrassStem blade = grass_stem(row, packed_blade);
  vec3 root = row.origin + grass_turned(row.turn, blade.root);
  float distance_m = length(root);
  float share = grass_share(lod, blade.width_m, distance_m);
  bool drawn = index < row.blades && blade.length_m > 0.0 && distance_m < row.max_distance_m &&
               (in_view(root, blade.length_m) || distance_m < lod.cast_m) &&
               grass_width_factor(lod, share, grass_rank(packed_blade), distance_m, row.max_distance_m) > 0.0;
  uint key = uint(clamp(distance_m / lod.range_m * 255.0, 0.0, 254.0));
  return drawn && key <= lod.threshold ? key : GLOAM_GRASS_CULLED;
}

void main() {
  GrassPatchRow row = patches[gl_WorkGroupID.x];
  uint word = 0u;
  for (uint i = 0u; i < 4u; ++i) word |= key_of(row, 4u * gl_LocalInvocationID.x + i) << (8u * i);
  keys[GLOAM_GRASS_PATCH_BLADES / 4u * gl_WorkGroupID.x + gl_LocalInvocationID.x] = word;
}
