// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_REFLECTIONS_HIT_DISTANCE_API_GLSL
#define GLOAM_SHADERS_REFLECTIONS_HIT_DISTANCE_API_GLSL

// Distances along a reflected ray from the surface to the hit, in two channels of an 8-bit unorm image: hundredths of
// ReflectionConstants::unit_m (centimetres where that is 1), the low byte in x, the high byte in y. Fetch them without
// filtering. Arguments and results below are in that unit.

const float kMostHitCentimetres = 65535.0;

// The nearest centimetre; 0 for NaN and negative distances, 655.35 m for greater ones.
vec2 pack_hit_distance(float metres) {
  float scaled = metres * 100.0;
  // A comparison with NaN is false on every device; min() and max() of NaN differ between devices.
  float centimetres = scaled > 0.0 ? floor((scaled < kMostHitCentimetres ? scaled : kMostHitCentimetres) + 0.5) : 0.0;
  float high = floor(centimetres / 256.0);
  return vec2(centimetres - 256.0 * high, high) / 255.0;
}

// The distance in metres.
float unpack_hit_distance(vec2 stored) {
  vec2 bytes = floor(stored * 255.0 + 0.5);
  return (bytes.y * 256.0 + bytes.x) / 100.0;
}

#endif
