// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/lights/one_light_view_api.glsl"

// Visualizer of one light in the early lists. If the list of a pixel's tile holds the light, the pixel is blue, or
// bright where the light reaches it. kLoud: the light reaches the pixel, but the list does not hold it.

void main() {
  uvec2 pixel = uvec2(gl_FragCoord.xy);
  bool in_list = list_holds(pixel);
  bool lit = lights_pixel(fetch_light(light_texels, shown_light), pixel);
  if (in_list) {
    show(with_grid(lit ? vec3(0.75, 0.9, 0.2) : vec3(0.02, 0.1, 0.6), pixel, GLOAM_SHADOW_TILE), kDarkened);
  } else {
    show(lit ? kLoud : vec3(0.0), lit ? kLoudOpacity : kDarkened);
  }
}
