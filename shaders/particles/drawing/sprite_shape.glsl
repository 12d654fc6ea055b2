// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_PARTICLES_DRAWING_SPRITE_SHAPE_GLSL
#define GLOAM_SHADERS_PARTICLES_DRAWING_SPRITE_SHAPE_GLSL

// A wave of period 1 in −1…1.
vec2 sprite_wave(vec2 x) {
  vec2 t = 2.0 * fract(x) - 1.0;
  return 4.0 * t * (1.0 - abs(t));
}

// Smooth noise in 0…1: warped waves.
float sprite_noise(vec2 at) {
  vec2 warped = at + 0.22 * sprite_wave(1.3 * at.yx + 0.37);
  vec2 coarse = sprite_wave(warped * vec2(0.55, 0.61)), fine = sprite_wave(warped.yx * vec2(1.37, 1.21) + 0.19);
  return 0.5 + 0.16 * (coarse.x + coarse.y) + 0.09 * (fine.x + fine.y);
}

// Share of a sprite's opacity at a point of it: a disc with a soft edge, eaten by noise. corner: the point's place,
// −1…1 along the sprite's axes. noise_at: the point in the noise.
float sprite_shape(vec2 corner, vec2 noise_at, float erosion) {
  float inside = max(1.0 - dot(corner, corner), 0.0);
  float noise = sprite_noise(noise_at);
  float body = clamp((inside + (noise - 1.0) * erosion) / (1.0 - 0.6 * erosion), 0.0, 1.0);
  return inside * body * (2.0 - body);
}

#endif
