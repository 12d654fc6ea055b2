// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/lit_tiles_shared.h"
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"

// Draws runs of changed tiles, one per instance: two triangles at depth 0.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 19, scalar) readonly buffer ChangedTiles { uint changed_tiles[]; };

void main() {
  uvec2 tiles = (uvec2(view.size) + uint(GLOAM_SHADOW_TILE) - 1u) / uint(GLOAM_SHADOW_TILE);
  uint word = changed_tiles[tiles.x * tiles.y + gl_InstanceIndex];
  int v = gl_VertexIndex;
  vec2 corner = vec2(v == 1 || v == 2 || v == 4, v == 2 || v > 3);
  vec2 first = vec2(word >> 10 & 0x7FFu, word >> 21), size = vec2((word & 0x3FFu) + 1u, 1.0);
  vec2 pixel = min((first + corner * size) * float(GLOAM_SHADOW_TILE), vec2(view.size));
  vec2 clip = pixel / vec2(view.size) * 2.0 - 1.0;
  gl_Position = vec4(clip.x, -clip.y, 0.0, 1.0);  // the viewport flips the y axis
}
