// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460

// The right side of a wipe: copies a picture of the window's size, and draws the line along its left side.

const float kLinePixels = 3.0;  // dark, light, dark: visible on any picture

layout(set = 0, binding = 0) uniform sampler2D right_picture;

layout(push_constant) uniform Push { float line_x; };  // left side of the line, pixels

layout(location = 0) out vec4 out_color;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  float across = gl_FragCoord.x - line_x;
  vec3 shown = texelFetch(right_picture, pixel, 0).rgb;
  if (across < kLinePixels) shown = vec3(abs(across - 0.5 * kLinePixels) < 0.5 ? 1.0 : 0.0);
  out_color = vec4(shown, 1.0);
}
