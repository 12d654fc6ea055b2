// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/grass/drawing/pose_shared.h"
#include "shaders/grass/grass_shared.h"
#include "shaders/grass/lod/lod_shared.h"

// Lists for each part of a shadow map's face the blades that may cast into it. One thread per casting blade. The blade
// is bounded by a sphere about its root that holds the knots which shadow maps draw.

layout(local_size_x = 64) in;

layout(constant_id = 0) const uint kSegments = 3u;  // of blades in shadow maps

layout(set = 0, binding = 0, scalar) readonly buffer Parts { GrassCasterPart parts[]; };
layout(set = 0, binding = 1, scalar) readonly buffer Poses { GrassPose poses[]; };
layout(set = 0, binding = 2, scalar) readonly buffer Knots { vec4 knots[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Casting { GrassCasting casting; };
layout(set = 0, binding = 4, scalar) readonly buffer Casters { uint casters[]; };  // see pose.comp
layout(set = 0, binding = 5, scalar) readonly buffer Draws { GrassDraws draws; };
// A GrassCasting for each part, GLOAM_GRASS_PART_WORDS apart, all words 0 before.
layout(set = 0, binding = 6, scalar) buffer PartCasting { uint part_casting[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer PartCasters { uint part_casters[]; };
layout(push_constant, scalar) uniform Constants { uvec2 counts; };  // parts; room of each part's list

vec3 posed(GrassPose pose, vec3 v) { return vec3(dot(pose.row0.xyz, v), dot(pose.row1.xyz, v), dot(pose.row2.xyz, v)); }

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= casting.count) return;
  uint listed = casters[i];
  GrassPose pose = poses[min(listed & ~GLOAM_GRASS_NOT_WIDER, max(draws.live, 1u) - 1u)];
  vec3 root = knots[pose.first_knot].xyz;
  float radius = 0.0;
  const uint step_of = (uint(GLOAM_GRASS_KNOTS) - 1u) / kSegments;
  for (uint k = step_of; k < uint(GLOAM_GRASS_KNOTS); k += step_of)
    radius = max(radius, length(posed(pose, knots[pose.first_knot + k].xyz - root)));
  vec2 width = unpackHalf2x16(pose.width);
  radius += 0.5 * casting.wider * width.x * max(width.y, 1.0);
  radius = 1.001 * radius * draws.units_per_metre;
  vec3 center = (posed(pose, root) + vec3(pose.row0.w, pose.row1.w, pose.row2.w)) * draws.units_per_metre;
  radius += 1e-5 * (abs(center.x) + abs(center.y) + abs(center.z));
  uint part = 0u;
  while (part < counts.x) {
    GrassCasterPart p = parts[part];
    float nearest = dot(p.planes[0].xyz, center) + p.planes[0].w;
    for (int side = 1; side < 5; ++side) nearest = min(nearest, dot(p.planes[side].xyz, center) + p.planes[side].w);
    bool seen = nearest >= -radius && (p.reach.w <= 0.0 || distance(p.reach.xyz, center) <= p.reach.w + radius);
    if (seen) {
      uint word = part * GLOAM_GRASS_PART_WORDS, place = atomicAdd(part_casting[word + 5u], 1u);
      if (place < counts.y) part_casters[part * counts.y + place] = listed;
      if (place == 0u) {
        part_casting[word] = casting.draw.indices;
        part_casting[word + 2u] = casting.draw.first_index;
        part_casting[word + 6u] = floatBitsToUint(casting.wider);
      }
      atomicMax(part_casting[word + 1u], place / GLOAM_GRASS_DRAW_BLADES + 1u);
    }
    ++part;
  }
}
