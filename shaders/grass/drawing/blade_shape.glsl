// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_DRAWING_BLADE_SHAPE_GLSL
#define GLOAM_SHADERS_GRASS_DRAWING_BLADE_SHAPE_GLSL

// The corner of a blade that a vertex stands for. A blade has two vertices at each of its segments' knots, left and
// right of the stem, and an instance has GLOAM_GRASS_DRAW_BLADES blades.

#include "shaders/common/math.glsl"
#include "shaders/grass/drawing/pose_shared.h"
#include "shaders/grass/grass_shared.h"
#include "shaders/grass/lod/lod_shared.h"

layout(set = 0, binding = 1, scalar) readonly buffer Poses { GrassPose poses[]; };  // of the sorted blades
layout(set = 0, binding = 2, scalar) readonly buffer Draws { GrassDraws draws; };
layout(set = 0, binding = 3, scalar) readonly buffer Knots { vec4 knots[]; };

const float kAhead_m = 0.01;

struct BladeVertex {
  vec3 relative;  // camera-relative, in units
  vec3 middle;    // of the stem
  vec3 ahead;     // a point farther along the stem
  vec3 normal;
  vec3 binormal;
  float along;   // 0 root … 1 tip
  float across;  // −1 left, 1 right
  uint layer;
  float threshold;  // of pixel_width.glsl
  uint pose;
  uint knot;  // in knots
};

vec3 posed(GrassPose pose, vec3 v) { return vec3(dot(pose.row0.xyz, v), dot(pose.row1.xyz, v), dot(pose.row2.xyz, v)); }

// Which of its draw's blades a vertex belongs to.
uint blade_of_vertex(uint instance, uint vertex, uint segments) {
  return instance * GLOAM_GRASS_DRAW_BLADES + vertex / (2u * (segments + 1u));
}

// place: of the blade's pose. wider: factor of its width.
BladeVertex blade_vertex(uint place, uint vertex, uint segments, float wider) {
  uint corner = vertex % (2u * (segments + 1u));
  BladeVertex v;
  v.pose = place;
  GrassPose pose = poses[v.pose];
  uint last = uint(GLOAM_GRASS_KNOTS) - 1u, knot = corner / 2u * last / segments;
  v.knot = pose.first_knot + knot;
  vec3 at = knots[v.knot].xyz;
  vec3 tangent =
      posed(pose, knots[pose.first_knot + min(knot + 1u, last)].xyz - knots[pose.first_knot + max(knot, 1u) - 1u].xyz);
  tangent *= inversesqrt(max(dot(tangent, tangent), 1e-20));
  vec3 side = octahedral_decode(unpackSnorm2x16(pose.side));
  side -= tangent * dot(side, tangent);
  side *= inversesqrt(max(dot(side, side), 1e-20));
  vec2 width = unpackHalf2x16(pose.width);
  v.along = float(knot) / float(last);
  v.across = (corner & 1u) == 0u ? -1.0 : 1.0;
  float half_width_m = 0.5 * wider * width.x * mix(1.0, width.y, v.along * v.along);
  vec3 middle = posed(pose, at) + vec3(pose.row0.w, pose.row1.w, pose.row2.w);
  vec3 metric = middle + side * (v.across * half_width_m);
  v.relative = metric * draws.units_per_metre;
  v.middle = middle * draws.units_per_metre;
  v.ahead = (middle + tangent * kAhead_m) * draws.units_per_metre;
  v.binormal = side;
  v.normal = cross(side, tangent);
  v.layer = pose.layer & 0xFFFFu;
  v.threshold = float(pose.layer >> 16) / 65535.0;
  return v;
}

#endif
