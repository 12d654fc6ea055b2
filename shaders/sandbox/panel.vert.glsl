// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Draws Dear ImGui's triangles. Positions are in pixels from the upper left corner of the picture.

layout(push_constant, scalar) uniform Push { vec2 size; }
push;  // size of the picture, pixels

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec4 color;
layout(location = 0) out vec2 out_uv;
layout(location = 1) out vec4 out_color;

void main() {
  out_uv = uv;
  out_color = color;
  vec2 unit = position / push.size;
  gl_Position = vec4(unit.x * 2.0 - 1.0, 1.0 - unit.y * 2.0, 0.0, 1.0);
}
