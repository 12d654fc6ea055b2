// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights/lights_api.glsl"
#include "shaders/render/view_api.glsl"

// Draws fallback tiles, one per instance: two triangles at depth 0.

layout(set = 0, binding = 0, scalar) uniform ViewBlock { ViewConstants view; };
layout(set = 0, binding = 19, scalar) readonly buffer FallbackTiles { uint fallback_tiles[]; };

void main() {
  uint word = fallback_tiles[gl_InstanceIndex];
  int v = gl_VertexIndex;
  vec2 corner = vec2(v == 1 || v == 2 || v == 4, v == 2 || v > 3);
  vec2 pixel = min((vec2(word & 0xFFFFu, word >> 16) + corner) * float(GLOAM_SHADOW_TILE), vec2(view.size));
  vec2 clip = pixel / vec2(view.size) * 2.0 - 1.0;
  gl_Position = vec4(clip.x, -clip.y, 0.0, 1.0);  // the viewport flips the y axis
}
