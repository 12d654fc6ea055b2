// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_BLADE_API_GLSL
#define GLOAM_SHADERS_GRASS_BLADE_API_GLSL

#include "shaders/common/math.glsl"
#include "shaders/grass/grass_shared.h"

// Positions are `precise`: a driver may otherwise contract and reorder their computation, and not each time alike.

// A blade row, unpacked. Positions are relative to the patch's origin. At rest, knot k of a blade is
// root + length · (stem[k].x · forward + stem[k].y · normal).
struct GrassStem {
  vec3 root;
  vec3 normal;   // unit
  vec3 forward;  // unit, perpendicular to normal: direction in which the stem leans
  float yaw;     // radians
  float length_m;
  float width_m;
};

// Forward for yaw 0 is +X, turned by the least rotation that takes +Y to the ground normal; yaw turns it about the
// normal, counter-clockwise seen from above.
vec3 grass_forward(vec3 normal, float yaw) {
  precise float share = 1.0 / max(1.0 + normal.y, 1e-4);
  precise vec3 x_axis = vec3(1.0 - normal.x * normal.x * share, -normal.x, -normal.x * normal.z * share);
  precise vec3 z_axis = vec3(-normal.x * normal.z * share, -normal.z, 1.0 - normal.z * normal.z * share);
  vec2 turn = unit_circle(yaw / (2.0 * kPi));
  precise vec3 forward = x_axis * turn.x - z_axis * turn.y;
  return forward;
}

GrassStem grass_stem(GrassPatchRow patch_row, GrassBladeRow row) {
  GrassStem s;
  vec2 xz = unpackUnorm2x16(row.root_xz);
  vec2 y = unpackUnorm2x16(row.root_y_normal);
  precise vec3 root = patch_row.box_from + patch_row.box_size * vec3(xz.x, y.x, xz.y);
  s.root = root;
  s.normal = octahedral_decode(unpackSnorm4x8(row.root_y_normal).zw);
  s.yaw = 2.0 * kPi / 255.0 * float(row.kind & 0xFFu);
  s.forward = grass_forward(s.normal, s.yaw);
  vec2 size = unpackHalf2x16(row.size);
  s.length_m = size.x;
  s.width_m = size.y;
  return s;
}

// A vector along the patch's axes, turned to the world's axes; grass_unturned() is the inverse. Exact without a turn.
vec3 grass_turned(vec4 turn, vec3 v) {
  precise vec3 turned = v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v);
  return turned;
}
vec3 grass_unturned(vec4 turn, vec3 v) { return grass_turned(vec4(-turn.xyz, turn.w), v); }

uint grass_type(GrassBladeRow row) { return row.kind >> 8 & 0xFu; }
uint grass_layer(GrassBladeRow row) { return row.kind >> 12 & 0xFu; }
// GrassPose::layer of a blade: a procedural colour, or GLOAM_GRASS_COLORS and the layer of an image.
uint grass_color(GrassPatchRow patch_row, GrassBladeRow row) {
  uint layers = patch_row.texture >> 16, layer = grass_layer(row);
  uint in_array = uint(GLOAM_GRASS_COLORS) + (patch_row.texture & 0xFFFFu) + layer % max(layers, 1u);
  return layers > 0u ? in_array : layer;
}
uint grass_master(GrassBladeRow row) { return row.kind >> 16 & 0xFFu; }
float grass_rank(GrassBladeRow row) { return float(row.kind >> 24) / 255.0; }

// Knot of a blade at rest, relative to its root.
vec3 grass_rest(GrassStem s, vec2 stem) {
  precise vec3 at = s.length_m * (stem.x * s.forward + stem.y * s.normal);
  return at;
}

#endif
