// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lighting/lighting_shared.h"

// Draws the rectangles that antialiasing blends, two triangles each.

layout(push_constant, scalar) uniform Blend { AntialiasingConstants c; };
layout(set = 0, binding = 3, scalar) readonly buffer Rectangles { uvec2 rectangles[]; };  // as in weights.comp.glsl

void main() {
  uvec2 rectangle = rectangles[gl_VertexIndex / 6];
  int v = gl_VertexIndex % 6;
  uvec2 corner = uvec2(v == 1 || v == 2 || v == 4, v == 2 || v > 3);
  uvec2 pixel = uvec2(rectangle.x & 0xFFFFu, rectangle.x >> 16);
  pixel += corner * uvec2(rectangle.y & 0xFFFFu, rectangle.y >> 16);
  vec2 clip = vec2(pixel) / vec2(c.size) * 2.0 - 1.0;
  gl_Position = vec4(clip.x, -clip.y, 0.0, 1.0);  // the viewport flips the y axis
}
