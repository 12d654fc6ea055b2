// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/reflections/reflections_shared.h"
#include "shaders/render/view_shared.h"

// Draws the tiles of the reflection images over the picture, one per instance: those with a mirror surface, or the
// others. Two triangles at depth 0, or none.

layout(constant_id = 0) const uint kMirror = 1u;

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 1, scalar) uniform Reflection { ReflectionConstants reflection; };
layout(set = 0, binding = 15, scalar) readonly buffer Roughness { uint tile_roughness[]; };

void main() {
  uint row = (reflection.size.x + GLOAM_REFLECTION_GROUP - 1u) / GLOAM_REFLECTION_GROUP, tile = uint(gl_InstanceIndex);
  bool drawn = (tile_roughness[tile] != 0u) == (kMirror != 0u);
  int v = gl_VertexIndex;
  vec2 corner = vec2(v == 1 || v == 2 || v == 4, v == 2 || v > 3);
  float side = float(GLOAM_REFLECTION_GROUP) * float(reflection.scale);
  vec2 pixel = min((vec2(tile % row, tile / row) + corner) * side, vec2(view.size));
  vec2 clip = pixel / vec2(view.size) * 2.0 - 1.0;
  gl_Position = drawn ? vec4(clip.x, -clip.y, 0.0, 1.0) : vec4(2.0, 2.0, 0.0, 1.0);  // the viewport flips the y axis
}
