// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_EXT_scalar_block_layout : require

// Passes clip-space positions and colours to triangle.frag, for the tests of drawing.

layout(location = 0) in vec3 position;  // clip space
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 out_color;

void main() {
  gl_Position = vec4(position, 1.0);
  out_color = color;
}
