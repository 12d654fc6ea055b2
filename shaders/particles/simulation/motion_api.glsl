// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#ifndef GLOAM_SHADERS_PARTICLES_SIMULATION_MOTION_API_GLSL
#define GLOAM_SHADERS_PARTICLES_SIMULATION_MOTION_API_GLSL

#include "shaders/common/math.glsl"
#include "shaders/particles/particles_shared.h"

// The state of a particle from its number and age. Drag and buoyancy pull its velocity v towards the emitter's rise:
//   dv/dt = drag · (rise − v)
// whose solution is exact. Turbulence adds the velocity of a field without divergence, summed along the way in fixed
// steps of the lifetime. Each frame repeats a particle's few steps from its birth: nothing is kept over frames, and its
// past way never changes.

// Four random words of a particle (Jarzynski and Olano 2020, pcg4d).
uvec4 particle_lot(uint seed, uint number, uint lot) {
  uvec4 v = uvec4(number, seed, lot, number ^ seed) * 1664525u + 1013904223u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  v ^= v >> 16u;
  v.x += v.y * v.w;
  v.y += v.z * v.x;
  v.z += v.x * v.y;
  v.w += v.y * v.z;
  return v;
}

// 24 bits of each word as 0…1, below 1.
vec4 unit_lot(uvec4 lot) { return vec4(lot >> 8u) * (1.0 / 16777216.0); }

// A wave of period 1 in −1…1, made of parabolas.
vec3 swirl_wave(vec3 x) {
  vec3 t = 2.0 * fract(x) - 1.0;
  return 4.0 * t * (1.0 - abs(t));
}

// Velocity of the turbulence over its greatest speed, −1…1 along each axis. at: in sizes of the swirls. No component
// depends on its own coordinate, so the divergence is 0. The phases repeat with time 1.
vec3 swirl(vec3 at, float time) {
  vec3 slow =
      swirl_wave(at.yzx + vec3(7.0, -5.0, 6.0) * time) + swirl_wave(at.zxy + vec3(0.37, 0.71, 0.13) - 4.0 * time);
  vec3 fast = swirl_wave(2.17 * at.yzx + vec3(0.5, 0.1, 0.8) - 9.0 * time) +
              swirl_wave(2.17 * at.zxy + vec3(0.9, 0.2, 0.6) + vec3(8.0, 11.0, -10.0) * time);
  return 0.34 * slow + 0.16 * fast;
}

// Way of a particle without turbulence after `time`. v: velocity at birth. way: that of a particle of 1 m/s without
// rise, (1 − exp(−drag · time)) / drag.
vec3 calm_way(ParticleEmitterRow e, vec3 v, float way, float time) {
  return v * way + vec3(0.0, e.rise * (time - way), 0.0);
}

// share: of the lifetime. Rises from 0, and falls back to 0.
float particle_opacity(ParticleEmitterRow e, float share) {
  float rising = clamp(share * e.per_fade_in, 0.0, 1.0), falling = clamp((1.0 - share) * e.per_fade_out, 0.0, 1.0);
  return e.opacity * rising * rising * (3.0 - 2.0 * rising) * falling * falling * (3.0 - 2.0 * falling);
}

// Velocity of the turbulence around a particle of this age when its age was `then`. at: from the emitter's origin.
vec3 particle_flow(ParticleEmitterRow e, vec3 at, float age, float then) {
  return e.turbulence * swirl(at * e.inverse_swirl, e.swirl_time + (then - age) / GLOAM_PARTICLE_SWIRL_PERIOD);
}

// The vector, no longer than 1, in 10 bits for each axis; 0 is exact.
uint packed_outward(vec3 v) {
  uvec3 bits = uvec3(v * 511.0 + 512.5);
  return bits.x | (bits.y << 10u) | (bits.z << 20u);
}

// Where light comes from that the plume does not keep away: out of it, across its way. Particles of one age lie around
// a middle in a normal distribution; a plume of these with the optical depth τ lets exp(−τ/2 (1 ± erf)) through from
// either side, so that the light of both sides together, 1 ± n, has n = tanh(τ/2 · erf(d / (√2 σ))). Both functions are
// x / √(1 + x²) here.
// off: from the middle of the particles of this age. pace: along the plume, m of it for a second of age. way: of
// calm_way(), with age. growth: factor of the size at birth.
vec3 outward_of_plume(ParticleEmitterRow e, vec3 off, vec3 pace, float way, float age, float growth, float opacity) {
  float places = e.birth_wide2 + e.way_wide2 * way * way + e.drift_wide2 * age * age;
  float inverse_wide2 = 1.0 / (places + e.size_wide2 * growth * growth);
  // A plume no longer than it is wide is a cloud, whose middle is a point.
  float inverse_pace2 =
      1.0 / (dot(pace, pace) + places * e.pace2_of_places + e.pace2_of_way * way * way + e.least_pace2);
  vec3 across = off - pace * (dot(off, pace) * inverse_pace2);
  float hidden = e.hiding * growth * growth * opacity;
  float half_depth2 = (hidden * inverse_pace2) * (hidden * inverse_wide2);
  float steps2 = 0.64 * inverse_wide2;  // erf(x / √2) has the slope 0.8
  return across * sqrt(steps2 * half_depth2 / (1.0 + steps2 * dot(across, across) * (1.0 + half_depth2)));
}

// Age of the live particle k of the emitter.
float particle_age(ParticleEmitterRow e, uint k) { return max(e.oldest_age_s - float(k) * e.interval_s, 0.0); }

// The live particle k of the emitter, which has this row. carried: velocity of the emitter at the particle's birth.
Particle particle_state(ParticleEmitterRow e, uint row, uint k, vec3 carried) {
  uvec4 lot_a = particle_lot(e.seed, e.oldest + k, 0u), lot_b = particle_lot(e.seed, e.oldest + k, 1u);
  vec4 a = unit_lot(lot_a), b = unit_lot(lot_b);
  float age = particle_age(e, k);
  vec3 birth = (a.x - 0.5) * e.box_x + (a.y - 0.5) * e.box_y + (a.z - 0.5) * e.box_z;
  float cosine = mix(1.0, e.cos_spread, b.x), sine = sqrt(max(1.0 - cosine * cosine, 0.0));
  vec2 about = unit_circle(b.y);
  vec3 direction = cosine * e.axis + sine * (about.x * e.across_x + about.y * e.across_y);
  vec3 v = direction * (e.speed * mix(GLOAM_PARTICLE_SLOWEST, GLOAM_PARTICLE_FASTEST, b.z));

  vec3 drift = vec3(0.0), flow = particle_flow(e, birth, age, 0.0);
  float way = 0.0, half_per_step = 0.5 / e.swirl_step_s;
  for (int i = 1; i <= GLOAM_PARTICLE_SWIRL_STEPS; ++i) {
    // The flow changes linearly during a step, towards the one where it would carry the particle.
    float then = float(i) * e.swirl_step_s, past = clamp(age - then + e.swirl_step_s, 0.0, e.swirl_step_s);
    way = e.step_way + e.step_decay * way;
    vec3 next = particle_flow(e, birth + calm_way(e, v, way, then) + drift + flow * e.swirl_step_s, age, then);
    drift += past * (flow + (past * half_per_step) * (next - flow));
    flow = next;
  }

  Particle p;
  p.life = min(age * e.inverse_life, 1.0);
  float calm = age * decay_mean(e.drag * age), growth = mix(1.0, e.growth, p.life);
  vec3 thrown = birth + v * calm + drift;
  p.position = e.origin + vec3(0.0, e.rise * (age - calm), 0.0) + thrown;
  p.radius_m = 0.5 * e.size_m * mix(GLOAM_PARTICLE_SMALLEST, GLOAM_PARTICLE_LARGEST, a.w) * growth;
  p.angle = 2.0 * kPi * b.w + e.spin * age * (2.0 * b.z - 1.0);
  p.opacity = particle_opacity(e, p.life);
  p.look = (row & 0xFFFFu) | (lot_b.w & 0xFFFF0000u);
  vec3 middle = e.mean_speed * e.axis;
  float calmed = e.drag * calm;
  vec3 pace = middle * (1.0 - calmed) + vec3(0.0, e.rise * calmed, 0.0) - carried;
  p.outward = packed_outward(outward_of_plume(e, thrown - middle * calm, pace, calm, age, growth, p.opacity));
  return p;
}

#endif
