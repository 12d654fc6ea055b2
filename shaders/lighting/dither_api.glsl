// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_LIGHTING_DITHER_API_GLSL
#define GLOAM_SHADERS_LIGHTING_DITHER_API_GLSL

// Rounds encoded colours to 8 bits with a fixed pattern, so that smooth gradients show no bands. The pattern is the
// additive recurrence R2 in two dimensions (Martin Roberts 2018, "The Unreasonable Effectiveness of Quasirandom
// Sequences"), in integers, so that it is the same on all devices. Neighbours differ much and means over a few pixels
// are nearly exact. Channels are a third of the range apart, so that their errors cancel in luminance.

// In [0, 1), multiples of 2^-24.
vec3 dither_pattern(uvec2 pixel) {
  uint number = pixel.x * 3242174889u + pixel.y * 2447445414u;
  return vec3(uvec3(number, number + 1431655765u, number + 2863311531u) >> 8u) * (1.0 / 16777216.0);
}

// x: encoded, in [0, 1]. Returns multiples of 1/255. The added noise is triangular in (-1, 1) steps; within half a step
// of black and white it is even in half a step. Either way the mean over the pattern is x, and 0 and 1 stay exact.
vec3 dithered(vec3 x, uvec2 pixel) {
  vec3 steps = min(x * 255.0003, vec3(255.0));  // an encoded 1 may be less by rounding
  vec3 even = dither_pattern(pixel);
  vec3 triangle =
      mix(1.5 - sqrt(2.0 - 2.0 * even), sqrt(2.0 * even) - 0.5, lessThan(even, vec3(0.5)));  // in (-0.5, 1.5)
  vec3 noise = mix(triangle, even, greaterThan(abs(steps - 127.5), vec3(127.0)));
  return min(floor(steps + noise), vec3(255.0)) * (1.0 / 255.0);
}

#endif
