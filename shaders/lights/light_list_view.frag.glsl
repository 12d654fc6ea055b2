// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights/one_light_view.glsl"

// The pixels that look at one light because their tile's early list holds it: blue, and bright where the light reaches the pixel. Loud
// where it reaches a pixel whose list does not hold it.

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  if (shown_light >= grid.local_count) {
    show(vec3(0.0), kDarkened);
    return;
  }
  bool held = list_holds(pixel / GLOAM_SHADOW_TILE);
  bool lit = lights_pixel(fetch_light(light_texels, shown_light), pixel);
  if (!held) {
    show(lit ? kLoud : vec3(0.0), lit ? 0.95 : kDarkened);
    return;
  }
  show(with_grid(lit ? vec3(0.75, 0.9, 0.2) : vec3(0.02, 0.1, 0.6), pixel, GLOAM_SHADOW_TILE), kDarkened);
}
