// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
//
// A particle's state is a function of its emitter, its number and its age. Particle n of an emitter is born at n / rate
// seconds, for all integers n: an emitter has always been running. So nothing has to be kept or caught up with when an
// emitter comes into view, and a frame depends on its time only.
#pragma once

#include <cstdint>

namespace gloam {

/// Particles live on a grid of time of 1/240 s, which holds the frames of 24, 30, 60, 120 and 240 Hz.
inline constexpr double kParticleStepsPerSecond = 240.0;

/// The step of a time: the last one that has begun, with a tolerance for sums of frame times. NaN and infinity are
/// step 0; times beyond ±1e9 s are clamped.
[[nodiscard]] std::int64_t particle_step(double time_s);

/// The particles of an emitter that are alive at a step: their ages are in [0, lifetime).
struct LiveParticles {
  std::int64_t oldest = 0;    ///< number of the oldest
  std::uint32_t count = 0;    ///< numbers follow each other
  double oldest_age_s = 0.0;  ///< particle oldest + k has the age oldest_age_s − k / rate
};
/// rate: 1/s, > 0. lifetime_s > 0. rate · lifetime_s ≤ 1e6.
[[nodiscard]] LiveParticles live_particles(double rate, double lifetime_s, std::int64_t step);

}  // namespace gloam
