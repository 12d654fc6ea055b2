// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTS_LIGHT_VIEWS_API_GLSL
#define GLOAM_SHADERS_LIGHTS_LIGHT_VIEWS_API_GLSL

// Shared by the fragment shaders of the light visualizers: the two targets, the colours and the tile grid.

#include "shaders/common/math.glsl"
#include "shaders/lights/lights_shared.h"

layout(constant_id = 0) const uint kEncode = 0u;  // 1: the picture's format does not encode sRGB, so the shader does

layout(location = 0) out vec4 out_color;  // over the picture
layout(
    location = 1) out vec4 out_named;  // the image named after the visualizer: numbers, or the colours encoded as sRGB

const vec3 kLoud = vec3(1.0, 0.0, 0.25);  // marks errors
const float kLoudOpacity = 0.95;
const float kDarkened = 0.75;  // opacity of other colours where the picture should show through

// Outputs a linear colour with this opacity over the picture.
void show(vec3 color, float opacity) {
  vec3 encoded = linear_to_srgb(color);
  out_color = vec4(kEncode != 0u ? encoded : color, opacity);
  out_named = vec4(encoded, opacity);
}

// Outputs a colour for a number, and the number.
void show_number(vec3 color, float opacity, float number) {
  show(color, opacity);
  out_named = vec4(number, 0.0, 0.0, 1.0);
}

// Darkens the upper and left border of tiles of `side` pixels.
vec3 with_grid(vec3 color, uvec2 pixel, uint side) { return any(equal(pixel % side, uvec2(0))) ? color * 0.6 : color; }

#endif
