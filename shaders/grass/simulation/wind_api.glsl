// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_GRASS_SIMULATION_WIND_API_GLSL
#define GLOAM_SHADERS_GRASS_SIMULATION_WIND_API_GLSL

#include "shaders/grass/grass_shared.h"

// Wind with gusts that travel over the field: two octaves of value noise over x and z, on lattices of 8 m and 2 m that
// repeat after GLOAM_GRASS_WIND_PERIOD. They depend on position and drift only. CPU twin:
// modules/grass/simulation/wind.

uint wind_hash(ivec2 cell, uint octave) {
  uint h = uint(cell.x) * 0x9E3779B1u ^ uint(cell.y) * 0x85EBCA77u ^ octave * 0xC2B2AE3Du;
  h = (h ^ h >> 15) * 0x2C1B3C6Du;
  h = (h ^ h >> 12) * 0x297A2D39u;
  return h ^ h >> 15;
}

// Values in [-1, 1] of a lattice point: x for the strength, y for the direction.
vec2 wind_lattice(ivec2 cell, uint octave) {
  uint h = wind_hash(cell, octave);
  precise vec2 values = vec2(h & 0xFFFFu, h >> 16) * (2.0 / 65535.0) - 1.0;
  return values;
}

vec2 wind_mix(vec2 a, vec2 b, float share) {
  precise vec2 mixed = a + (b - a) * share;
  return mixed;
}

// Value noise. at: in cells; cells: of a period, a power of two.
vec2 wind_noise(vec2 at, int cells, uint octave) {
  precise vec2 corner = floor(at);
  precise vec2 t = at - corner;
  t = t * t * (3.0 - 2.0 * t);
  ivec2 from = ivec2(corner) & (cells - 1);
  ivec2 to = (from + 1) & (cells - 1);
  precise vec2 near = wind_mix(wind_lattice(from, octave), wind_lattice(ivec2(to.x, from.y), octave), t.x);
  precise vec2 far = wind_mix(wind_lattice(ivec2(from.x, to.y), octave), wind_lattice(to, octave), t.x);
  return wind_mix(near, far, t.y);
}

// Velocity of the air, m/s. at: position in the wind's field (GrassPatchRow::wind_at plus a position in the patch).
vec3 wind_velocity(GrassWind wind, vec3 at) {
  precise vec2 p = (at.xz - wind.drift.xz) * 0.125;
  int cells = int(GLOAM_GRASS_WIND_PERIOD) / 8;
  precise vec2 gust = (wind_noise(p, cells, 0u) * 2.0 + wind_noise(p * 4.0, cells * 4, 1u)) * (wind.gust / 3.0);
  vec3 side = vec3(wind.velocity.z, 0.0, -wind.velocity.x);
  precise vec3 velocity = wind.velocity * (1.0 + 1.5 * gust.x) + side * (0.75 * gust.y);
  return velocity;
}

#endif
