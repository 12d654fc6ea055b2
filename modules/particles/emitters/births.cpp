// SPDX-FileCopyrightText: The gloam authors
// SPDX-License-Identifier: MIT
#include "modules/particles/emitters/births.h"

#include <algorithm>
#include <cmath>

namespace gloam {

std::int64_t particle_step(double time_s) {
  if (!std::isfinite(time_s)) return 0;
  return static_cast<std::int64_t>(std::floor(std::clamp(time_s, -1e9, 1e9) * kParticleStepsPerSecond + 1e-4));
}

LiveParticles live_particles(double rate, double lifetime_s, std::int64_t step) {
  const double time_s = static_cast<double>(step) / kParticleStepsPerSecond;
  const auto newest = static_cast<std::int64_t>(std::floor(time_s * rate));
  auto oldest = static_cast<std::int64_t>(std::floor((time_s - lifetime_s) * rate)) + 1;
  const auto age = [&](std::int64_t number) { return time_s - static_cast<double>(number) / rate; };
  // Rounding of the products may be off by one.
  while (age(oldest) >= lifetime_s) ++oldest;
  LiveParticles live;
  live.oldest = oldest;
  live.count = static_cast<std::uint32_t>(std::max<std::int64_t>(newest - oldest + 1, 0));
  live.oldest_age_s = age(oldest);
  return live;
}

}  // namespace gloam
